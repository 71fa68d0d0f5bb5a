// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line that misses the gap with its sides moved outward by a margin misses it for sure; one that crosses
// the gap with its sides moved inward is over it for sure. For an observer on the border of a gap neither
// would ever hold. There, a line that leaves the gap across the observer's own side, at an angle larger than
// rounding, misses it.
#include "terrain/viewshed/near_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {

void ViewshedNearGaps::add(std::span<const Vec2> corners) {
  const auto next = [&](std::size_t i) { return corners[(i + 1) % corners.size()]; };
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += corners[i].x * next(i).y - corners[i].y * next(i).x;
  Gap gap;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = next(i);
    const double length = std::copysign(std::hypot(b.x - a.x, b.y - a.y), area);
    const Vec2 out{(b.y - a.y) / length, (a.x - b.x) / length};
    gap.sides[gap.count++] = {out, -(out.x * a.x + out.y * a.y)};
  }
  gaps_.push_back(gap);
}

ViewshedNearGaps::Crossing ViewshedNearGaps::towards(double u) const {
  constexpr double kRounding = 1e-8;
  const double x = 1 / std::sqrt(1 + u * u), margin = kRounding + 2 * error_;
  const Vec2 direction{x, u * x};
  Crossing crossing;
  for (const Gap& gap : gaps_) {
    if (gap.isLeft(direction, kRounding + error_)) continue;
    crossing.isPossible |= gap.length(direction, margin) >= 0;
    crossing.isCertain |= gap.length(direction, -margin) > kRounding;
  }
  return crossing;
}

/// Whether the line leaves the gap before it is over it for a length that counts.
bool ViewshedNearGaps::Gap::isLeft(Vec2 direction, double error) const {
  constexpr double kCounts = 1e-10;
  return std::any_of(sides.begin(), sides.begin() + count, [&](const Side& side) {
    const double outward = side.out.x * direction.x + side.out.y * direction.y - error;
    return outward > 0 && -side.distance <= kCounts * outward;
  });
}

/// Length of the line over the gap if the gap's sides are moved outward by `margin`; negative: none.
double ViewshedNearGaps::Gap::length(Vec2 direction, double margin) const {
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double outward = sides[i].out.x * direction.x + sides[i].out.y * direction.y,
                 away = margin - sides[i].distance;
    if (outward > 0) {
      last = std::min(last, away / outward);
    } else if (outward < 0) {
      first = std::max(first, away / outward);
    } else if (away < 0) {
      return -1;
    }
  }
  return last - first;
}

}  // namespace arete
