// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "engine/mt/node_blocks.h"
#include "io/format/metadata.h"
#include "io/packed/errors.h"
#include "io/packed/heights.h"
#include "io/packed/layout.h"
#include "io/packed/zeroed_arena.h"

namespace arete::packed {

/// A triangle of the root, or one that a chunk leaves to others: all that they need to take it away, in one
/// place. The first corner is the apex; `across` has what lay across each edge when the chunk ended (the id
/// of a triangle, or kNone).
struct alignas(32) Border {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t id;
  std::array<std::uint32_t, 3> across;
};

/// As many as Arrays::kLeft leaves numbers for.
inline constexpr std::uint64_t kMostBorders = (1u << 30) - 1;

/// Plan coordinates and raw height of a vertex. w is 0.
template <class Real>
struct alignas(4 * sizeof(Real)) Place {
  Real x, y, z, w;
};

/// The MT that grows while a packed file is read, or while one is written: the arrays of MtArrays, and what
/// is needed only on the way.
struct Arrays {
  std::uint32_t rootVertices = 0, roots = 0, nodes = 0, slots = 0;
  bool isLattice = true;
  bool hasFills = false;  ///< rims may reach over NODATA
  std::uint32_t columns = 0, rows = 0;
  HeightEncoding encoding;
  OutwardScale scale;
  MetricFrame metric;

  /// Those that stay, and those that go when all is read.
  ZeroedArena stays, goes;
  ZeroedArray<std::array<std::uint32_t, 3>> rootTriangles;
  ZeroedArray<std::uint32_t> slotBegin, link, remover, floor, creatorHint;
  ZeroedArray<std::uint16_t> error, below, above, saturatedError;
  ZeroedArray<Sphere> sphere;
  NodeBlocks blocks;
  ZeroedArray<std::uint32_t> samples;
  ZeroedArray<Vec2> plan;
  ZeroedArray<std::byte> rawHeights;

  /// Places of the vertices, in float where that holds them exactly (holdsFloats()), else in double.
  ZeroedArray<Place<float>> floatPlaces;
  ZeroedArray<Place<double>> doublePlaces;
  /// Codes of errors of whole-numbered heights: by doubled area, up to kLatticeErrorArea, and error * area.
  std::vector<std::uint16_t> wholeErrors;
  ZeroedArray<std::uint8_t> star;  ///< slots of a node, + kOpen; 0 = not there yet
  ZeroedArray<Border> border;      ///< of the root's triangles, then of the chunks' (Chunk::firstBorder)
  static constexpr std::uint8_t kOpen = 128;

  /// The remover of a triangle that nobody has removed, until all is read: the front's record of it, for the
  /// chunk that is at work; or, with kLeft as well, its place in `border`.
  static constexpr std::uint32_t kMark = 1u << 31, kLeft = 1u << 30, kMarks = kMark | kLeft;
  static bool isLeft(std::uint32_t remover) { return (remover & kMarks) == kMarks; }

  /// All arrays, of the sizes stated in MtArrays, and borders of the chunks. False when there is not enough
  /// memory.
  bool allocate(const AmtCounts& counts, std::uint64_t borders);
  /// Fills the root's borders from rootTriangles.
  void joinRoot();
  /// The root's removers, creatorHint and the end of slotBegin. Precondition: all chunks have been saturated.
  void finish();
  /// What stays of them.
  static MultiTriangulation model(std::shared_ptr<Arrays> arrays);

  bool holdsFloats() const {
    constexpr std::uint32_t kMost = 1u << 22;
    return isLattice && columns <= kMost && rows <= kMost && encoding.type != HeightEncoding::Type::float64;
  }
  template <class Real>
  Place<Real>* places() const {
    if constexpr (std::is_same_v<Real, float>)
      return floatPlaces.get();
    else
      return doublePlaces.get();
  }
  double height(std::uint32_t vertex) const { return rawHeight(encoding.type, rawHeights.get(), vertex); }
  std::uint32_t starSize(std::uint32_t node) const { return star[node] & (kOpen - 1u); }
  bool isOpen(std::uint32_t node) const { return (star[node] & kOpen) != 0; }
};

/// Saturated errors and spheres of the nodes of a chunk, from those of their children, which are complete:
/// see engine/mt/recorder.h. A node's sphere holds its star when this is called. Nothing, or what is wrong: a
/// saturated error outside of its band. A node's saturated error is the largest of its floor when this is
/// called. Of a part of an MT (`isPart`) some children are missing; its
/// saturated errors are at least the lowest of their band. What nobody removed loses its mark.
std::optional<std::string> saturate(Arrays& arrays, const Chunk& chunk, bool isPart);

}  // namespace arete::packed
