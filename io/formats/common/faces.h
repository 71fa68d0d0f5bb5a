// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"

namespace arete {

/// Collects the faces of a mesh while its vertices may still be unknown, since in most formats a face may
/// name a vertex that comes later. Until finish(), a face of n corners is a fan of n - 2 triangles, and what
/// belongs to a face is listed by face: objectOf, groupOf, materialOf and the triangle attributes of the
/// mesh.
class MeshFaces {
 public:
  /// Adds a face to the triangles of the mesh. One of fewer than three corners has no triangles, but counts.
  /// @param wedges Of the corners, in every face or in none.
  void add(SurfaceMesh& mesh, std::span<const std::uint32_t> corners,
           std::span<const std::uint32_t> wedges = {});

  std::uint64_t size() const { return faces_; }

  /// Replaces the fans by triangulatePolygon() (io/formats/common/polygon.h): seen from above if all faces of
  /// the mesh show the same side there, as those of a terrain do. The triangles of a face keep its place, its
  /// wedges and its error. A triangle that would have one vertex twice is left out. If faces have outlines
  /// that cross themselves, file.warnings counts them and gives the number of the first. Then what is listed
  /// by face is listed by triangle, and the mesh has faceOf unless every face is one triangle.
  ///
  /// Preconditions: every index has a finite position; triangleErrors has one per triangle, or none.
  ///
  /// Errors: interrupted, without a culprit. O(triangles) where the fans are right.
  Status finish(MeshFile& file, const RunContext& context);

 private:
  struct Fan {
    std::uint64_t face;  ///< counted from 1
    std::size_t first;   ///< triangle
    std::size_t corners;
  };
  Status triangulate(MeshFile& file, const RunContext& context);

  std::vector<Fan> fans_;
  std::uint64_t faces_ = 0;
  bool listsFaces_ = false;  // faceOf is listed: a face was no triangle
};

}  // namespace arete
