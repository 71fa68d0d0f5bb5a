// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "engine/mt/node_blocks.h"
#include "io/store/format/schema.h"
#include "io/store/packed/nodes/errors.h"
#include "io/store/packed/nodes/heights.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/nodes/zeroed_arena.h"

namespace arete::packed {

/// A triangle of the root, or one that a packet leaves to others: what they need to remove it. The first
/// corner is the apex; `across` is what lay across each edge when the packet ended: the id of a triangle, or
/// kNone.
struct alignas(32) Border {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t id;
  std::array<std::uint32_t, 3> across;
};

/// The largest number of borders: Arrays::kLeft leaves 30 bits for an index.
inline constexpr std::uint64_t kMostBorders = (1u << 30) - 1;

/// Plan coordinates and raw height of a vertex. w is 0.
template <class Real>
struct alignas(4 * sizeof(Real)) Place {
  Real x, y, z, w;
};

/// What the vertices and triangles of an MT are, as its metadata says.
struct MtKind {
  ModelKind model = ModelKind::terrain;

  // Of a heightfield.
  bool isLattice = true;
  bool hasFills = false;  ///< rims may reach over NODATA
  std::uint32_t columns = 0, rows = 0;
  HeightEncoding encoding;

  // Of a surface.
  bool hasDoubles = false;  ///< places are doubles, not floats
  double step = 0;          ///< a power of two that all coordinates are multiples of; 0: none is known
  double moved = 0;         ///< how far rounding has moved a vertex: the spheres hold the source before it

  OutwardScale scale;
  MetricFrame metric;

  bool hasPlan() const { return model == ModelKind::terrain; }
  /// Those that decide which columns the MT has.
  AmtFacts facts() const;
};

/// The MT that grows while a packed file is read, or while one is written: its columns, and what is needed
/// only on the way.
struct Arrays : MtKind {
  std::uint32_t rootVertices = 0, roots = 0, nodes = 0, slots = 0;

  /// Memory of the columns of the MT, and of the arrays that are only needed while packets are coded.
  ZeroedArena stays, goes;
  struct Column : AmtMtColumn {
    ZeroedArray<std::byte> memory = {};
    std::size_t elements = 0;
  };
  std::vector<Column> mtColumns;  ///< of the kind's schema, without columns of blocks

  // The same by their types; those that the kind does not have are empty.
  ZeroedArray<std::array<std::uint32_t, 3>> rootTriangles;
  ZeroedArray<std::uint32_t> slotBegin, link, remover, floor, creatorHint;
  ZeroedArray<std::uint16_t> error, below, above, rms, saturatedError;
  ZeroedArray<Sphere> sphere;
  ZeroedArray<std::uint32_t> samples;
  ZeroedArray<Vec2> plan;
  ZeroedArray<std::byte> rawHeights;
  ZeroedArray<std::array<float, 3>> places32;
  ZeroedArray<Vec3> places64;
  NodeBlocks blocks;

  /// Positions of the vertices of a heightfield: floats where these are exact (holdsFloats()), otherwise
  /// doubles.
  ZeroedArray<Place<float>> floatPlaces;
  ZeroedArray<Place<double>> doublePlaces;
  /// Error codes of whole-numbered heights, by doubled area (at most kLatticeErrorArea) and error * doubled
  /// area.
  std::vector<std::uint16_t> wholeErrors;
  /// Of a surface: codes of the error and RMS of all triangles that stay.
  std::uint16_t finestError = 0, finestRms = 0;
  unsigned errorShift = 0;             ///< all of these codes are multiples of 2^errorShift
  std::vector<std::uint64_t> missing;  ///< MtArrays::missing
  ZeroedArray<std::uint8_t> star;      ///< slots of a node, + kOpen; 0 = not there yet
  ZeroedArray<Border> border;  ///< of the root's triangles, then of the packets' (Packet::firstBorder)
  static constexpr std::uint8_t kOpen = 128;

  /// While packets are coded, the remover of a triangle that is not removed yet is kMark and the index of the
  /// front's record of it, or kMark, kLeft and its index in `border`.
  static constexpr std::uint32_t kMark = 1u << 31, kLeft = 1u << 30, kMarks = kMark | kLeft;
  static bool isLeft(std::uint32_t remover) { return (remover & kMarks) == kMarks; }

  /// Allocates all arrays, with the sizes that the counts call for, and the borders of the packets.
  /// @return false if there is not enough memory
  bool allocate(const AmtCounts& counts, std::uint64_t borders);
  /// About the bytes that allocate() takes, and finish() beside them.
  static std::uint64_t bytesOf(const MtKind& kind, const AmtCounts& counts, std::uint64_t borders);
  /// Sets the typed arrays to the memory of their columns.
  void bindColumns();
  /// Fills the root's borders from rootTriangles.
  void joinRoot();
  /// Fills the root's removers, creatorHint, the end of slotBegin and the errors of triangles that stay.
  /// Precondition: all packets are saturated. @param isPart some nodes were not read: also fills `missing`
  void finish(bool isPart);
  /// The MT of the arrays. Frees the others.
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
  /// Gives a typed array the memory of the column of that tag; none if the kind does not have it.
  template <class T>
  void bind(const AmtTag& tag, ZeroedArray<T>& to) const {
    for (const Column& column : mtColumns)
      if (column.tag == tag)
        to = {reinterpret_cast<T*>(column.memory.get()), column.elements * column.elementBytes() / sizeof(T)};
  }
  /// The place of a vertex of a surface.
  Vec3 place(std::uint32_t vertex) const {
    if (hasDoubles) return places64[vertex];
    const auto& [x, y, z] = places32[vertex];
    return {x, y, z};
  }
  /// Precondition: the place is one of floats unless hasDoubles.
  void setPlace(std::uint32_t vertex, const Vec3& p) const {
    if (hasDoubles)
      places64[vertex] = p;
    else
      places32[vertex] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  double height(std::uint32_t vertex) const { return rawHeight(encoding.type, rawHeights.get(), vertex); }
  std::uint32_t starSize(std::uint32_t node) const { return star[node] & (kOpen - 1u); }
  bool isOpen(std::uint32_t node) const { return (star[node] & kOpen) != 0; }
};

/// Computes the saturated errors and spheres of a packet's nodes from those of their children
/// (engine/mt/recorder.h), and replaces the marks of triangles without a remover by kNone.
/// Precondition: each node's sphere contains its star and its saturated error is the largest of its floor;
/// the packets that depend on this one are saturated.
/// @param isPart  some children were not read: saturated errors are raised to the lowest of their band
/// @return what is wrong with the packet (a damaged file), or nothing
std::optional<std::string> saturate(Arrays& arrays, const Packet& packet, bool isPart);

}  // namespace arete::packed
