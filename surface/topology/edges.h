// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/ids.h"
#include "engine/memory/uninitialized_vector.h"

namespace arete {

/// A corner of a triangle: 3 t + i is corner i of triangle t, and side i, which runs from it to the next
/// corner.
using CornerId = Id<struct CornerTag>;

inline CornerId cornerOf(TriangleId triangle, unsigned side) {
  return CornerId(3 * triangle.index() + side);
}
inline TriangleId triangleOf(CornerId corner) {
  return TriangleId(corner.index() / 3);
}
inline CornerId nextCorner(CornerId c) {
  return CornerId(c.index() % 3 == 2 ? c.index() - 2 : c.index() + 1);
}
inline CornerId previousCorner(CornerId c) {
  return CornerId(c.index() % 3 == 0 ? c.index() + 2 : c.index() - 1);
}

/// The edges of a triangle mesh, each with the sides of triangles that lie on it. Any triangles will do: an
/// edge may have one side (a border), two, or more (non-manifold), oriented in any way.
///
/// Memory: 8 bytes a side and 4 an edge; 8 more a side and a vertex while it is made.
class MeshEdges {
 public:
  using Corners = std::array<std::uint32_t, 3>;  ///< vertices

  /// O(triangles + vertices + sum of d log d over the numbers d of edges at a vertex). Keeps a reference to
  /// `triangles`. Preconditions: corners are below vertexCount; there are fewer than 2^32 / 3 triangles.
  MeshEdges(std::span<const Corners> triangles, std::size_t vertexCount);

  struct Edge {
    VertexId low, high;               ///< low < high; equal where a triangle has one vertex twice
    std::span<const CornerId> sides;  ///< in increasing order
    bool isBorder() const { return sides.size() == 1; }
    bool isManifold() const { return sides.size() <= 2; }
  };

  std::size_t size() const { return firstSide_.size() - 1; }
  /// Edges are ordered by their lower vertex, then by the higher one.
  Edge operator[](std::size_t edge) const;
  /// The edge of a side.
  std::size_t edgeOf(CornerId side) const { return edgeOf_[side.index()]; }

  std::span<const Corners> triangles() const { return triangles_; }
  std::size_t vertexCount() const { return vertexCount_; }
  VertexId origin(CornerId side) const { return VertexId(triangles_[side.index() / 3][side.index() % 3]); }
  /// The end of a side.
  VertexId target(CornerId side) const { return origin(nextCorner(side)); }
  /// Whether two sides of one edge run in opposite directions, as those of coherently oriented neighbours do.
  bool areOpposed(CornerId a, CornerId b) const { return origin(a) != origin(b); }
  /// The side across a manifold edge that is no border; invalid across any other.
  CornerId across(CornerId side) const;

 private:
  std::span<const Corners> triangles_;
  std::size_t vertexCount_;
  UninitializedVector<CornerId> sides_;           // by edge
  UninitializedVector<std::uint32_t> firstSide_;  // per edge, and the end
  UninitializedVector<std::uint32_t> edgeOf_;     // by side
};

}  // namespace arete
