// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "engine/base/vec.h"
#include "engine/simplify/hole_triangles.h"
#include "engine/simplify/live_mesh.h"
#include "surface/model/parts.h"
#include "surface/simplify/state.h"

namespace arete {

/// The triangles of a fan around a corner of a hole: what the collapse of the removed vertex into that corner
/// leaves.
HoleTriangulation fanAround(int corner, int corners);

/// Answers whether two vertices have an edge, for a mesh that does not change meanwhile. Of two vertices that
/// both have many neighbours the answer is kept: a vertex between them asks again and again.
class KnownEdges {
 public:
  /// O(the smaller of their degrees) once, and where that is more than 64, O(1) from then on.
  bool haveEdge(const LiveMesh& mesh, VertexId a, VertexId b);

 private:
  std::unordered_map<std::uint64_t, bool> known_;  // by both ids, the smaller one in the high bits
};

/// The hole that the removal of a vertex leaves, and the fans that may fill it. The mesh does not change
/// while holes are gathered and asked.
///
/// A fan keeps the surface a manifold of the same topology if none of its new edges is an edge of the mesh
/// already (the link condition [DeyEdelsbrunnerGuhaNekhayev1999]). It turns no triangle over: each turns
/// like the one that it replaces. On a line, where labels change, only the fans around the line's own
/// neighbours keep the line. Where one side of it is a single triangle, the line continues along the edge
/// beyond: the side must go on there, so that a part never vanishes, and a closed line keeps three vertices.
class SurfaceHole {
 public:
  /// Gathers the star of v and reads nothing beyond it. False if no fan may fill it while the star is as it
  /// is.
  bool gather(const SurfaceState& state, VertexId v);

  const Star& star() const { return star_; }
  VertexId vertex() const { return vertex_; }
  const Vec3& apex() const { return apex_; }
  const StarLine& line() const { return line_; }
  /// The triangle of the star that is alone on its side of the line; -1: there is none.
  int ear() const {
    if (!line_.isThere()) return -1;
    const int triangles = line_.ends[1] - line_.ends[0];
    return triangles == 1 ? line_.ends[0] : star_.triangleCount - triangles == 1 ? line_.ends[1] : -1;
  }
  int corners() const { return star_.linkSize; }
  const Vec3& corner(int i) const { return places_[i]; }
  std::span<const Vec3> places() const { return {places_.data(), static_cast<std::size_t>(star_.linkSize)}; }

  /// Whether the fan around a corner keeps lines and turns no triangle over.
  bool keepsShape(int corner) const;
  /// Whether the fan around a corner folds the surface: turns two triangles at an edge further towards each
  /// other than any at the star were, and by more than 120 degrees. Reads the triangles around the star.
  bool folds(const SurfaceState& state, int corner);
  /// Whether any fan keeps the topology and every part. Reads the mesh around the star.
  bool mayBeFilled(const SurfaceState& state);
  /// Whether the fan around a corner keeps the topology, if any does. Reads the mesh around the corner.
  bool keepsTopology(const SurfaceState& state, int corner);

  /// The labels of a triangle of a fan.
  TriangleLabels labelsOf(const SurfaceState& state, const std::array<std::uint8_t, 3>& triangle) const;

 private:
  void gatherBeyond(const SurfaceState& state);
  bool goesOnBeyond(const SurfaceState& state, int triangle) const;
  int next(int i) const { return i + 1 < star_.linkSize ? i + 1 : 0; }
  int previous(int i) const { return i > 0 ? i - 1 : star_.linkSize - 1; }
  bool areNeighbours(int i, int j) const { return next(i) == j || next(j) == i; }

  VertexId vertex_;
  Star star_;
  Vec3 apex_;
  std::array<Vec3, kMaxHoleCorners> places_;
  std::array<Vec3, kMaxHoleCorners> normals_;  // of the star's triangles
  Vec3 normal_;                                // their sum
  /// Of the triangles beyond the link's edges, of length 1 or 0; and the least cosine between the normals of
  /// two triangles at an edge of the star. Known from gatherBeyond() on.
  std::array<Vec3, kMaxHoleCorners> beyond_;
  double sharpest_ = 1;
  bool hasBeyond_ = false;
  StarLine line_;
  KnownEdges edges_;
};

}  // namespace arete
