// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_mesh.h"
#include "engine/base/vec.h"

namespace arete {

/// Nearest-point queries on a mesh in space, by a bounding volume hierarchy of its triangles.
class NearestOnMesh {
 public:
  struct Answer {
    Vec3 point;                  ///< on the mesh
    std::uint32_t triangle = 0;  ///< one that holds the point
    double distance = 0;
    std::uint32_t looks = 0;  ///< boxes and leaves that the search opened
  };

  /// Copies the triangles. Those without area are segments or points. Precondition: the mesh has a triangle
  /// and validate()s. O(n log n); about 180 bytes per triangle, and
  /// as much again for long ones that lie aslant.
  explicit NearestOnMesh(const TriangleMesh& mesh);
  ~NearestOnMesh();
  NearestOnMesh(const NearestOnMesh&) = delete;
  NearestOnMesh& operator=(const NearestOnMesh&) = delete;

  /// The point of the mesh nearest to `p`. Deterministic and thread-safe. About O(log n) near the mesh,
  /// around a vertex of many triangles too.
  Answer nearest(const Vec3& p) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace arete
