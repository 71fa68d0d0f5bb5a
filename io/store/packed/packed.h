// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"
#include "io/store/format/load_parts.h"
#include "io/store/format/page_need.h"
#include "io/store/format/required_error.h"
#include "io/store/packed/nodes/layout.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct AmtMetadata;
struct SurfaceMetadata;

namespace packed {
/// Where the chunks of a paged MT lie; of blocks and nodes only parts need to be in memory.
struct PagedMt {
  std::span<const std::byte> root, tables, blocks, nodes;
};
}  // namespace packed

/// The packed form of a multitriangulation (docs/topics/amt-format.md, "Packed"): the contents of three
/// chunks, together a ninth to a fifteenth of the arrays.
struct PackedMt {
  std::vector<std::byte> directory, tables, nodes;
  std::vector<std::byte> blocks;  ///< of pages: the directory below its root
};

struct PackOptions {
  bool isPaged = false;  ///< in pages (io/store/packed/pages)
};

/// Packs the MT of a model. unpackMt() restores the same nodes: the same triangles with the same errors,
/// renumbered within each band. Bounds are rounded outwards to quarters of an octave (the lesser of the two
/// by more where it is far below the greater one). Saturated errors become the least ones, which are those of
/// a build; spheres are computed anew. Packing what was unpacked gives the same bytes, for any number of
/// threads. Errors, without a culprit: invalidData: an MT that breaks laws 1 to 4, or an error beyond its
/// scale; outOfMemory; interrupted. O(triangles) time, about 150 bytes per node beside
/// the model.
Result<PackedMt> packMt(const TerrainModel& model, const PackOptions& options = {},
                        const RunContext& context = {});

/// Unpacks an MT, or the part of it that a query requires. Whatever the bytes are, the result is an error or
/// an MT whose indices are in range and whose floors, removers, links and spheres are related as engine/mt
/// states; the counts of the metadata are compared with the bytes before memory is allocated. Packets are
/// decoded in parallel; the result does not depend on the threads.
///
/// @param wanted  the error required of boxes; called once for each packet, with a box around the floors
///                and stars of all its nodes, which may be far larger than each of them. Null requires
///                everything. Where the same error is required everywhere, nodes keep the numbers that they
///                have in the whole.
/// @param load  for `nodes`; `directory` and `tables` are in memory
/// A saturated cut by region, focus or camera of a part may be coarser than that of the whole, because
/// spheres do not contain the nodes that were not read. Errors, without a culprit: corrupt: a wrong checksum,
/// invalid data; outOfMemory; interrupted. O(nodes whose saturated error is at least
/// half of the required one), 35 bytes per node beside the MT.
Result<MultiTriangulation> unpackMt(const AmtMetadata& metadata, std::span<const std::byte> directory,
                                    std::span<const std::byte> tables, std::span<const std::byte> nodes,
                                    const RequiredError& wanted = {}, const RunContext& context = {},
                                    const LoadParts& load = {});

/// The same of pages: only the blocks of the directory that may describe a required page are used, and of the
/// nodes the required pages, each down to its last required segment. Counts of pages are 64-bit; a part
/// has to fit 32-bit ids.
///
/// @param load for blocks and nodes; the others are in memory
/// The balls of nodes whose descendants were not read are as large as their page says that they may be, so
/// that no cut of a part is coarser than its criterion allows. Errors: as above.
Result<MultiTriangulation> unpackMt(const AmtMetadata& metadata, const packed::PagedMt& paged,
                                    const RequiredError& wanted, const RunContext& context,
                                    const LoadParts& load);

/// The pages that unpackMt() would use, in the order of the file, without reading one: each comes after those
/// that it depends on. What is needed where more error is allowed is a part of it.
///
/// @param scale of the errors, of the metadata
/// @param load for blocks
/// Errors, without a culprit: corrupt: a damaged block, a page outside the file. O(blocks used + pages in
/// them).
Result<std::vector<PageNeed>> neededPages(const OutwardScale& scale, const packed::PagedMt& paged,
                                          const RequiredError& wanted, const LoadParts& load);

/// How a surface is packed.
struct SurfacePackOptions {
  /// 0: vertices keep their places to the bit. Otherwise (8 to 24) they move to the nearest multiples of a
  /// power of two, of which the longest side of their box has at most 2^positionBits - 1; and errors grow by
  /// twice the largest move, so that they hold for the source as for the rounded surface; they are
  /// rounded upwards to 1/128 of an octave (0.8 %).
  int positionBits = 0;
  bool isPaged = false;
};

/// The order of a packed MT: by its vertices and triangles, those of the MT that was packed.
struct PackedOrder {
  UninitializedVector<std::uint32_t> vertexOf, triangleOf;
};

struct PackedSurfaceMt {
  PackedMt bytes;
  PackedOrder order;
  bool hasDoubles = false;  ///< places are doubles, not floats
  double step = 0;          ///< a power of two that all coordinates are multiples of; 0: not known
  double moved = 0;         ///< the largest distance by which rounding moved a vertex
  OutwardScale scale;       ///< of the errors
};

/// What the nodes of pages carry, by page and segment (io/store/packed/surface/carried.h).
using CarriedPages = std::vector<std::vector<std::vector<std::byte>>>;
/// Finds it for an MT whose pages are packed without it.
using CarryInPages = std::function<Result<CarriedPages>(const PackedSurfaceMt&)>;

/// Packs the MT of a surface, as packMt() does: vertices (unless positionBits says otherwise), triangles,
/// errors and root mean squares are restored to the bit. Errors: as packMt(), and invalidData: triangles that
/// stay with different errors.
/// @param carry of pages: finds what they carry
Result<PackedSurfaceMt> packSurfaceMt(const MultiTriangulation& mt, const SurfacePackOptions& options = {},
                                      const RunContext& context = {}, const CarryInPages& carry = {});

/// Unpacks all of it, as unpackMt() does.
Result<MultiTriangulation> unpackSurfaceMt(const SurfaceMetadata& metadata,
                                           std::span<const std::byte> directory,
                                           std::span<const std::byte> tables,
                                           std::span<const std::byte> nodes, const RunContext& context = {});

/// An MT of pages, and the pages that it consists of, with their headers read.
struct UnpackedPages {
  MultiTriangulation mt;
  packed::Directory pages;
};

/// The same for pages. A part can be required, as for terrain.
Result<UnpackedPages> unpackSurfaceMt(const SurfaceMetadata& metadata, const packed::PagedMt& paged,
                                      const RequiredError& wanted, const RunContext& context,
                                      const LoadParts& load);

/// The least error of the highest band that holds, together with the bands above it, at least `nodes` nodes.
/// @return 0 if that is the last band, or the directory is invalid. O(directory)
double packedErrorBeyond(std::span<const std::byte> directory, const OutwardScale& scale,
                         std::uint64_t nodes);
/// The same, of the root of a directory of pages.
double pagedErrorBeyond(std::span<const std::byte> root, const OutwardScale& scale, std::uint64_t nodes);

}  // namespace arete
