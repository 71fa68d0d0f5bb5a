// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/format/required_error.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct AmtMetadata;

/// The packed form of a multitriangulation (docs/topics/amt-format.md, "Packed"): a ninth to a fifteenth of
/// its arrays.
struct PackedMt {
  std::vector<std::byte> directory, tables, nodes;
};

/// Packs the MT of a model. What unpackMt() gives back has the same nodes, that is the same modifications:
/// the same triangles with the same errors, numbered anew within each band. Bounds are rounded outwards to
/// quarters of an octave (the lesser of the two to more where it is far below the greater one). Saturated
/// errors are the least ones, which are those of a build; spheres are computed anew. Packing what was
/// unpacked gives the same bytes, whatever the number of threads. Errors: invalidData (an MT that breaks the
/// laws 1 to 4, or holds an error beyond its scale), interrupted. O(triangles) time, and about 150 bytes per
/// node beside the model.
Result<PackedMt> packMt(const TerrainModel& model, const RunContext& context = {});

/// Unpacks. `counts`, `model` and the rest of the metadata are believed only where the bytes bear them out:
/// whatever the bytes are, the MT that comes back has its indices in range and its floors, removers, links
/// and spheres in the relations that MtArrays states, or there is an error. Chunks are decoded in parallel;
/// the result does not depend on it. Errors: corrupt (a checksum, or what makes no sense, named), unreadable
/// (more than memory holds), interrupted; without a culprit. O(triangles), 35 bytes per node beside the MT.
///
/// `wanted` is asked once for each chunk of nodes, with a box around all their floors and stars, which may be
/// far larger than each of them. A saturated cut by place of what is read may be coarser than that of the
/// whole, as no sphere holds a node that was not read. Where the same is wanted everywhere, nodes keep
/// the numbers that they have in the whole. The time is that of the nodes whose saturated errors are not
/// below half of what is wanted.
Result<MultiTriangulation> unpackMt(const AmtMetadata& metadata, std::span<const std::byte> directory,
                                    std::span<const std::byte> tables, std::span<const std::byte> nodes,
                                    const RequiredError& wanted = {}, const RunContext& context = {});

/// The least error of a band that is read with those above it, so many nodes or more; 0 where that is the
/// last one, or the directory makes no sense. O(directory).
double packedErrorBeyond(std::span<const std::byte> directory, const OutwardScale& scale,
                         std::uint64_t nodes);

}  // namespace arete
