// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/mt/hole_limit.h"

namespace arete {

/// The triangles that fill a star-shaped polygon, as numbers of its corners. Each starts at its lowest one.
/// They are in the order in which they were found; the same algorithm on the same polygon finds the same.
struct HoleTriangulation {
  std::array<std::array<std::uint8_t, 3>, kMaxHoleCorners - 2> triangles;
  int size = 0;
  void add(int i, int j, int m) {
    triangles[size++] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j),
                         static_cast<std::uint8_t>(m)};
  }
  std::span<const std::array<std::uint8_t, 3>> view() const {
    return {triangles.data(), static_cast<std::size_t>(size)};
  }
};

}  // namespace arete
