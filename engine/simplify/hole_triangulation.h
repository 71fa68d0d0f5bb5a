// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "engine/mt/hole_limit.h"

namespace arete {

/// Calls f with the number of corners as a constant where it is a usual one, else with 0. Nearly all stars
/// have so many, and a loop of known length needs no loop.
template <class F>
[[gnu::always_inline]] inline auto withCorners(int corners, const F& f) {
  switch (corners) {
    case 4:
      return f(std::integral_constant<int, 4>());
    case 5:
      return f(std::integral_constant<int, 5>());
    case 6:
      return f(std::integral_constant<int, 6>());
    case 7:
      return f(std::integral_constant<int, 7>());
    default:
      return f(std::integral_constant<int, 0>());
  }
}

/// A triangulation of a star polygon, as corners of the polygon. Each triangle starts at its least corner;
/// the list is in the order found, the same for the same polygon and the same way of finding it.
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
