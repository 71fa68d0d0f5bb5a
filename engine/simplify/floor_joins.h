// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "engine/simplify/hole_triangles.h"

namespace arete {

/// The adjacency of the triangles of a hole's triangulation: its diagonals with the triangle on either side,
/// and the triangle on each rim edge. Side c of a triangle runs from its corner c to the next.
///
/// Between 0 and the last corner of the polygon each is the middle corner of exactly one triangle, i < m < j,
/// whose side 2 lies towards the polygon's last edge: a binary tree, in which one comparison finds a
/// neighbour. O(corners), with no branch but those of two loops.
struct FloorJoins {
  struct Side {
    std::uint8_t triangle, side;
  };
  /// The diagonal between corners from < to.
  struct Diagonal {
    std::uint8_t from, to;
    Side forth;  ///< from -> to
    Side back;   ///< to -> from
  };

  std::array<Side, kMaxHoleCorners> rim;  ///< by corner: its edge to the next one
  std::array<Diagonal, kMaxHoleCorners - 2> diagonals;
  int diagonalCount = 0;

  /// Precondition: `floor` is not empty; its triangles i < m < j turn as the corners do.
  explicit FloorJoins(const HoleTriangulation& floor) {
    const int last = floor.size + 1;
    std::array<std::uint8_t, kMaxHoleCorners> triangleOf, leastOf;  // by middle corner
    triangleOf[0] = 0;
    leastOf[last] = kMaxHoleCorners;
    for (int f = 0; f < floor.size; ++f) {
      const auto [i, m, j] = floor.triangles[f];
      triangleOf[m] = static_cast<std::uint8_t>(f);
      leastOf[m] = i;
    }
    // An edge from a lower to a higher corner is side 0 of the triangle whose middle corner it ends at, or
    // side 1 of the triangle whose middle corner it starts at.
    const auto forth = [&](int from, int to) {
      const bool isFirst = leastOf[to] == from;
      return Side{triangleOf[from + (to - from) * int(isFirst)], static_cast<std::uint8_t>(!isFirst)};
    };
    for (int f = 0; f < floor.size; ++f) {
      const auto [i, m, j] = floor.triangles[f];
      const Side base{static_cast<std::uint8_t>(f), 2};
      rim[m] = forth(m, m + 1);
      if (j - i == last)
        rim[last] = base;
      else
        diagonals[diagonalCount++] = {i, j, forth(i, j), base};
    }
    rim[0] = forth(0, 1);
  }
};

}  // namespace arete
