// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete {

/// Points spread evenly over the surface of a mesh: the same number on every equal share of its area, and
/// within a triangle evenly again. The mean of a function over them estimates its mean over the surface, each
/// sample counting alike; the seed decides where the first ones fall.
///
/// Sample i depends on the mesh, the count, the seed and i alone, so samples can be taken in any order.
/// References the mesh.
class SurfaceSamples {
 public:
  /// Precondition: the mesh validate()s, is not empty and has area. O(triangles); 8 bytes per triangle.
  SurfaceSamples(const TriangleMesh& mesh, std::uint64_t count, std::uint64_t seed);

  std::uint64_t count() const { return begin_.back(); }
  std::uint64_t countOf(std::uint32_t triangle) const { return begin_[triangle + 1] - begin_[triangle]; }
  /// The triangle that sample i is on. O(log triangles).
  std::uint32_t triangleOf(std::uint64_t i) const;
  /// Sample i, which is on `triangle` = triangleOf(j) for a j <= i: moves `triangle` on to its own.
  Vec3 at(std::uint64_t i, std::uint32_t& triangle) const;

 private:
  const TriangleMesh& mesh_;
  std::uint64_t seed_;
  std::vector<std::uint64_t> begin_;  // first sample of each triangle, and the count
};

/// Sum of the areas of the triangles; those without area count nothing.
double surfaceArea(const TriangleMesh& mesh);

}  // namespace arete
