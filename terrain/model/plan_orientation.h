// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

#include "engine/base/vec.h"

namespace arete {

/// planOrientation() without the filter: CGAL's exact predicate.
int exactPlanOrientation(Vec2 a, Vec2 b, Vec2 c);

/// The orientation of three points: 1 where a, b, c turn counter-clockwise, 0 where they lie on one line, -1
/// otherwise. Exact for all finite doubles. In nearly all cases two products and a comparison, the filter of
/// orient2d [Shewchuk1997].
inline int planOrientation(Vec2 a, Vec2 b, Vec2 c) {
  constexpr double kRelative = (3 + 16 * 0x1p-53) * 0x1p-53;
  constexpr double kUnderflow = 0x1p-960;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double turn = left - right, doubt = kRelative * (std::abs(left) + std::abs(right)) + kUnderflow;
  if (turn > doubt) return 1;
  if (turn < -doubt) return -1;
  return exactPlanOrientation(a, b, c);
}

/// The barycentric coordinates of p in the triangle a, b, c, correct to the last bits however thin the
/// triangle is. Slow: computed as rational numbers. Precondition: finite, not on one line.
/// @return the weights of a, b and c: within 0 .. 1 for a p in the triangle, with the sum 1
std::array<double, 3> exactPlanWeights(Vec2 a, Vec2 b, Vec2 c, Vec2 p);

}  // namespace arete
