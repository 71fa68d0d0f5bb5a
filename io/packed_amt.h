// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "engine/result.h"
#include "engine/run_context.h"
#include "engine/vec.h"
#include "terrain/terrain_model.h"

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
/// laws 1 to 4, or holds an error beyond its scale), interrupted. O(triangles) time, and about 350 bytes per
/// node beside the model.
Result<PackedMt> packMt(const TerrainModel& model, const RunContext& context = {});

/// The least error that anybody asks for within a box of plan coordinates, in the unit of the heights: 0 (or
/// less, or NaN) for full resolution, infinity where nobody asks. Null asks for everything.
using WantedError = std::function<double(const Box2&)>;

struct UnpackOptions {
  /// Asked once for each chunk of nodes, with a box around all their floors and stars, which may be far
  /// larger than each of them. Read are the nodes that a minimal cut may ask for which allows every triangle
  /// the least error wanted of any box that it meets: these are the same cuts, with the same triangles in the
  /// same order, as those of the whole. A saturated cut by place may be a little coarser, as no sphere holds
  /// a node that was not read. Where the same is wanted everywhere, nodes keep the numbers that they have in
  /// the whole. The time is that of the nodes whose saturated errors are not below half of what is wanted.
  WantedError wanted = {};
};

/// Unpacks. `counts`, `model` and the rest of the metadata are believed only where the bytes bear them out:
/// whatever the bytes are, the MT that comes back has its indices in range and its floors, removers, links
/// and spheres in the relations that MtArrays states, or there is an error. Chunks are decoded in parallel;
/// the result does not depend on it. Errors: corrupt (a checksum, or what makes no sense, named), unreadable
/// (more than memory holds), interrupted; without a culprit. O(triangles), 35 bytes per node beside the MT.
Result<MultiTriangulation> unpackMt(const AmtMetadata& metadata, std::span<const std::byte> directory,
                                    std::span<const std::byte> tables, std::span<const std::byte> nodes,
                                    const UnpackOptions& options = {}, const RunContext& context = {});

}  // namespace arete
