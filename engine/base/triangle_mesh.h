// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"

namespace arete {

/// An indexed triangle mesh by value, as cuts are exported and mesh files are read. Triangles are
/// counter-clockwise seen from +z in the frame of the positions.
struct TriangleMesh {
  std::vector<Vec3> positions = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};

  /// Checks that every index refers to a position and every coordinate is finite. Errors: invalidData.
  /// O(size).
  Status validate() const;

  bool operator==(const TriangleMesh&) const = default;
};

}  // namespace arete
