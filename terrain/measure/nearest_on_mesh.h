// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_mesh.h"
#include "engine/base/vec.h"

namespace arete {

/// A search tree over the triangles of a mesh, in space.
class NearestOnMesh {
 public:
  struct Answer {
    Vec3 point;                  ///< on the mesh
    std::uint32_t triangle = 0;  ///< that it is on; one of them where several are as near
    double distance = 0;
  };

  /// Precondition: the mesh has a triangle and validate()s. Triangles without area count as the segments or
  /// points they are. O(n log n); about 160 bytes per triangle. The mesh is not needed afterwards.
  explicit NearestOnMesh(const TriangleMesh& mesh);
  ~NearestOnMesh();
  NearestOnMesh(const NearestOnMesh&) = delete;
  NearestOnMesh& operator=(const NearestOnMesh&) = delete;

  /// The point of the mesh that is nearest to `p`, the same whatever was asked before. From any number of
  /// threads. About O(log n) near the mesh.
  Answer nearest(const Vec3& p) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace arete
