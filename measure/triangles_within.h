// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/box3.h"
#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_mesh.h"

namespace arete {

/// Finds the triangles of a mesh within a distance of a point, by a binary tree of boxes.
class TrianglesWithin {
 public:
  struct Near {
    std::uint32_t triangle = 0;
    Vec3 nearest;  ///< its point nearest to p
    double squaredDistance = 0;
  };

  /// Precondition: the mesh outlives this and has a triangle. O(n log n)
  explicit TrianglesWithin(const TriangleMesh& mesh);

  /// All triangles no farther than `distance` from p, by rising number. O(log n + found) where triangles are
  /// of like size.
  /// @param most  where there are more, it ends with one more than these. @return whether it found all
  bool find(const Vec3& p, double distance, std::vector<Near>& found,
            std::size_t most = std::numeric_limits<std::size_t>::max()) const;

  SpaceTriangle at(std::uint32_t triangle) const {
    const auto& t = mesh_.triangles[triangle];
    return {mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]};
  }

 private:
  static constexpr std::uint32_t kInLeaf = 4;
  struct Node {
    Box3 box = Box3::empty();
    std::uint32_t begin = 0, end = 0;  // of order_
    std::uint32_t second = 0;          // the other child; the one is the next; 0: a leaf
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::span<const Vec3> middles);

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace arete
