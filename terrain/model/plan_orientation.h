// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

#include "engine/base/vec.h"

namespace arete {

/// The sign of planOrientation() where the filter cannot tell it: CGAL's exact predicate.
int exactPlanOrientation(Vec2 a, Vec2 b, Vec2 c);

/// > 0 when a, b, c turn counter-clockwise, 0 when they lie on one line, < 0 otherwise: exact for all finite
/// doubles. Two products and a comparison nearly always (the filter of Shewchuk's orient2d, 1997).
inline int planOrientation(Vec2 a, Vec2 b, Vec2 c) {
  constexpr double kRelative = (3 + 16 * 0x1p-53) * 0x1p-53;
  constexpr double kUnderflow = 0x1p-960;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double turn = left - right, doubt = kRelative * (std::abs(left) + std::abs(right)) + kUnderflow;
  if (turn > doubt) return 1;
  if (turn < -doubt) return -1;
  return exactPlanOrientation(a, b, c);
}

/// How much a, b and c weigh at p: 0 .. 1 each and together 1 for a p in the triangle, to the last bits
/// however thin it is. Slow: rational numbers. Precondition: finite, not on one line.
std::array<double, 3> exactPlanWeights(Vec2 a, Vec2 b, Vec2 c, Vec2 p);

}  // namespace arete
