// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// A triangle by its vertices, and what stands at its edges 0-1, 1-2, 2-0.
using ThreeIds = std::array<std::uint32_t, 3>;

/// The id of an edge that is not split.
inline constexpr std::uint32_t kUnsplit = 0xFFFFFFFF;

/// Triangles after edges were split at their middles.
struct DividedTriangles {
  std::vector<ThreeIds> triangles;
  std::vector<std::uint32_t> parents;  ///< by triangle: the one that it is a part of
};

/// Divides triangles so that the result conforms: into two, three or four by the number of their split edges.
/// Of the two ways with two split edges, the shorter diagonal is taken.
///
/// @param middles   by triangle: the vertex at the middle of each edge, or kUnsplit
/// @param positions by vertex, the middles among them
/// O(triangles).
DividedTriangles divideTriangles(std::span<const ThreeIds> triangles, std::span<const ThreeIds> middles,
                                 std::span<const Vec3> positions);

}  // namespace arete
