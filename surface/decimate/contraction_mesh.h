// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete {

/// A mesh whose vertices are contracted: each has a list of its triangles. Triangles keep their numbers.
class ContractionMesh {
 public:
  /// @param rounding  of coordinates when the mesh is written: triangles need a few times this height
  explicit ContractionMesh(const TriangleMesh& mesh, double rounding = 0);

  std::uint32_t triangleCount() const { return triangleCount_; }  ///< that are left
  std::size_t vertexCount() const { return positions_.size(); }   ///< of the source
  const Vec3& position(std::uint32_t v) const { return positions_[v]; }
  const std::array<std::uint32_t, 3>& corners(std::uint32_t t) const { return triangles_[t]; }
  bool isThere(std::uint32_t t) const { return isThere_[t] != 0; }
  /// In no particular order, which is the same each time.
  std::span<const std::uint32_t> trianglesOf(std::uint32_t v) const { return trianglesOf_[v]; }
  /// Of a usual vertex without memory of its own.
  using Neighbours = boost::container::small_vector<std::uint32_t, 24>;
  /// The vertices that have an edge to v, rising.
  void neighboursOf(std::uint32_t v, Neighbours& neighbours) const;
  /// Calls visit(triangle, corner) for each triangle that a contraction of some vertices leaves: those with
  /// one of them, at this corner.
  template <class Visit>
  void forLeft(std::span<const std::uint32_t> vertices, const Visit& visit) const {
    for (const std::uint32_t v : vertices)
      for (const std::uint32_t t : trianglesOf_[v]) {
        std::size_t members = 0, at = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          if (std::ranges::find(vertices, triangles_[t][c]) == vertices.end()) continue;
          ++members;
          at = c;
        }
        if (members == 1) visit(t, at);
      }
  }

  /// Whether the contraction of some vertices leaves a surface of the same topology: every two of them have a
  /// triangle in common with each common neighbour, edges have at most two triangles that turn alike, no two
  /// triangles have the same corners, and the triangles at the vertex are one fan.
  bool keepsTopology(std::span<const std::uint32_t> vertices) const;
  /// Whether no triangle that is left turns by more than 90 degrees or loses its area, but for those that
  /// have none.
  bool keepsTurns(std::span<const std::uint32_t> vertices, const Vec3& place) const;

  /// The first of the vertices stands for all of them, at a place. Triangles with two of them are gone, and
  /// those that would be there twice. O(triangles of the vertices), however many their neighbours have.
  void contract(std::span<const std::uint32_t> vertices, const Vec3& place);

 private:
  void attach(std::uint32_t t, std::size_t corner);
  void detach(std::uint32_t t, std::size_t corner);
  void remove(std::uint32_t t);

  std::vector<Vec3> positions_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint8_t> isThere_;
  std::vector<std::vector<std::uint32_t>> trianglesOf_;
  std::vector<std::array<std::uint32_t, 3>> entries_;  // by triangle and corner: its place in trianglesOf_
  std::uint32_t triangleCount_ = 0;
  double leastHeight_ = 0;
};

}  // namespace arete
