// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "terrain/hole.h"

namespace arete {

/// A triangulation of a hole of few corners in a word: that of a polygon is a binary tree (a triangle on each
/// edge from a lower to a higher corner, one below each of its other two sides), and the tree is written as
/// its nodes and leaves in preorder, 1 and 0, from the lowest bit up. The last leaf is left out.
class HoleCode {
 public:
  static constexpr int kMostCorners = 18;

  /// Precondition: corners <= kMostCorners, each triangle starts at its least corner.
  static std::uint32_t encode(const HoleTriangulation& floor, int corners) {
    std::array<std::array<std::uint8_t, kMostCorners>, kMostCorners> third;
    for (const auto& t : floor.view()) third[t[0]][t[2]] = t[1];
    std::array<std::array<std::uint8_t, 2>, kMostCorners> stack;
    int top = 0;
    stack[top++] = {0, static_cast<std::uint8_t>(corners - 1)};
    std::uint32_t code = 0;
    for (int bit = 0; bit < 2 * (corners - 2); ++bit) {
      const auto [i, j] = stack[--top];
      if (j - i < 2) continue;
      code |= std::uint32_t(1) << bit;
      const std::uint8_t m = third[i][j];
      stack[top++] = {m, j};
      stack[top++] = {i, m};
    }
    return code;
  }

  static HoleTriangulation decode(std::uint32_t code, int corners) {
    // Nodes whose first, or second, branch is being read.
    HoleTriangulation floor;
    std::array<std::uint8_t, kMostCorners> open;
    int depth = 0;
    std::uint8_t at = 0;  // the corner that what has been read reaches
    for (int bit = 0; bit <= 2 * (corners - 2); ++bit, code >>= 1) {
      if (code & 1) {
        open[depth++] = static_cast<std::uint8_t>(floor.size);
        floor.triangles[floor.size++] = {at, 0, 0};
        continue;
      }
      ++at;
      while (depth > 0) {
        auto& t = floor.triangles[open[depth - 1]];
        if (t[1] == 0) {
          t[1] = at;
          break;
        }
        t[2] = at;
        --depth;
      }
    }
    return floor;
  }
};

}  // namespace arete
