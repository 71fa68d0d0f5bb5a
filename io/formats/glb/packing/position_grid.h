// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/triangle_mesh.h"

namespace arete {

using Float3 = std::array<float, 3>;

/// The one grid of all positions of a file: corners that were at one place are at one place on it, whatever
/// primitive or object they are of.
struct PositionGrid {
  using Point = std::array<std::uint16_t, 3>;

  Float3 low{};
  float step = 1;

  /// The step is alike on all axes, so that normals need no other transform than positions.
  /// @param bits The longest side of the box has 2^bits - 1 steps, 1 to 16. O(positions).
  static PositionGrid of(std::span<const Float3> positions, int bits);

  Point nearest(const Float3& position) const;
};

/// How many places of positions are no longer places of their own. O(n log n).
std::uint64_t countFallenTogether(std::span<const Float3> positions, std::span<const PositionGrid::Point> on);

/// What a move of each vertex by at most half a step on each axis may add to an error of the mesh in the
/// axes and the unit of the positions, y up. Of a height field, whose triangles are all seen from above, the
/// errors are vertical: a shift sideways counts by the steepest slope. Of any other mesh they are distances.
/// O(size).
double errorOfGrid(const TriangleMesh& mesh, std::span<const Float3> positions, double step);

}  // namespace arete
