// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <type_traits>

namespace arete {

/// The most corners a hole can have: the largest degree bound a build accepts, and one more for an open star.
/// The file format relies on it: a floor has at most kMaxHoleCorners - 2 triangles.
inline constexpr int kMaxHoleCorners = 33;

/// Calls f with the number of corners as a compile-time constant where it is a common one, else with 0.
/// Nearly all stars have 4 to 7 corners, and a loop of known length is unrolled.
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

}  // namespace arete
