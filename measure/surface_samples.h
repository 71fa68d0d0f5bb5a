// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete {

/// Points distributed evenly over the surface of a mesh by systematic and low-discrepancy sampling
/// [Roberts2018]. The mean of a function over them, each with the same weight, estimates its mean over the
/// surface.
///
/// Sample i depends only on the mesh, the count, the seed and i, so samples can be taken in any order.
/// Keeps a reference to the mesh.
class SurfaceSamples {
 public:
  /// Precondition: the mesh validate()s, is not empty and has area. O(triangles); 8 bytes per triangle.
  /// @param count  of samples
  /// @param seed  determines the positions
  SurfaceSamples(const TriangleMesh& mesh, std::uint64_t count, std::uint64_t seed);

  std::uint64_t count() const { return begin_.back(); }
  std::uint64_t countOf(std::uint32_t triangle) const { return begin_[triangle + 1] - begin_[triangle]; }
  /// The triangle that sample i is on. O(log triangles).
  std::uint32_t triangleOf(std::uint64_t i) const;
  /// The position of sample i. Amortised O(1) for rising i.
  /// @param triangle  in: triangleOf(j) for some j <= i; out: triangleOf(i)
  Vec3 at(std::uint64_t i, std::uint32_t& triangle) const;

 private:
  const TriangleMesh& mesh_;
  std::uint64_t seed_;
  std::vector<std::uint64_t> begin_;  // first sample of each triangle, and the count
};

/// Sum of the areas of the triangles, in space.
double surfaceArea(const TriangleMesh& mesh);

}  // namespace arete
