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
#include "io/mesh/file.h"

namespace arete {

/// Collects the faces of a mesh while its vertices may still be unknown, since in most formats a face may
/// name a vertex that comes later. Until finish(), a face of n corners is a fan of n - 2 triangles.
class MeshFaces {
 public:
  /// Adds a face to the triangles. Precondition: at least three corners.
  void add(std::vector<std::array<std::uint32_t, 3>>& triangles, std::span<const std::uint32_t> corners);

  /// Replaces the fans by triangulatePolygon() (io/mesh/polygon.h): seen from above if all faces of the mesh
  /// show the same side there, as those of a terrain do. The triangles of a face keep its place
  /// and its error. A triangle that would have one vertex twice is left out. If faces have outlines that
  /// cross themselves, file.warnings counts them and gives the number of the first.
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
  std::vector<Fan> fans_;
  std::uint64_t faces_ = 0;
};

}  // namespace arete
