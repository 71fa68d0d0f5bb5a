// SPDX-License-Identifier: GPL-3.0-or-later
//
// The upright plane through a leg cuts a triangle in a segment of distances and heights. The line is convex
// over distance, so it crosses the segment once if the segment's ends are on both sides of it, and otherwise
// twice or never, which its least clearance above the segment tells.
#include "io/query/sight/crossing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arete {
namespace {

/// The segment in which an upright plane cuts a triangle, as pairs (along, height) of its ends.
std::optional<std::array<Vec2, 2>> cutUpright(Vec2 from, Vec2 step, const std::array<Vec3, 3>& corners) {
  std::array<double, 3> side;
  int left = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    side[i] = step.x * (corners[i].y - from.y) - step.y * (corners[i].x - from.x);
    left += side[i] >= 0;
  }
  if (left == 0 || left == 3) return std::nullopt;
  const double length2 = step.x * step.x + step.y * step.y;
  std::array<Vec2, 2> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t right = i, other = (i + 1) % 3;
    if ((side[right] >= 0) == (side[other] >= 0)) continue;
    if (side[right] >= 0) std::swap(right, other);
    const Vec3 &a = corners[right], &b = corners[other];
    const double f = side[right] / (side[right] - side[other]);
    const double x = a.x + f * (b.x - a.x) - from.x, y = a.y + f * (b.y - a.y) - from.y;
    ends[count++] = {(x * step.x + y * step.y) / length2, a.z + f * (b.z - a.z)};
  }
  return ends;
}

}  // namespace

// By bisection, which cannot leave the range; few lines come here.
double LineCrossing::root(const Point& from, const Point& to) const {
  Point low = from, high = to;
  const bool isAbove = above(low) >= 0;
  for (int i = 0; i < 64 && low.s != high.s; ++i) {
    const Point middle{low.s / 2 + high.s / 2, low.z / 2 + high.z / 2};
    ((above(middle) >= 0) == isAbove ? low : high) = middle;
  }
  return low.s;
}

bool LineCrossing::isAtAnEnd(double s) const {
  const double z = line_.height(s), unit = line_.heightUnitMetres();
  return std::hypot(s, (z - line_.fromHeight()) * unit) < kSightEndMetres ||
         std::hypot(line_.length() - s, (z - line_.toHeight()) * unit) < kSightEndMetres;
}

std::optional<double> LineCrossing::along(const SceneLeg& leg, const std::array<Vec3, 3>& corners) const {
  const auto cut = cutUpright(leg.from, leg.step, corners);
  if (!cut) return std::nullopt;
  const auto pointOf = [&](Vec2 end) {
    return Point{leg.s0 + end.x * leg.ds, end.y / frame_.scale.z + frame_.origin.z};
  };
  Point a = pointOf((*cut)[0]), b = pointOf((*cut)[1]);
  if (b.s < a.s) std::swap(a, b);
  if (b.s < leg.first || a.s > leg.last) return std::nullopt;
  const auto at = [a, b](double s) { return Point{s, a.z + (s - a.s) / (b.s - a.s) * (b.z - a.z)}; };
  if (a.s < leg.first) a = at(leg.first);
  if (b.s > leg.last) b = at(leg.last);
  const bool isAbove = above(a) >= 0;
  if (isAbove != (above(b) >= 0)) {
    const double s = root(a, b);
    return isAtAnEnd(s) ? std::nullopt : std::optional(s);
  }
  if (!isAbove || !(b.s > a.s)) return std::nullopt;
  const auto least = line_.least(a.s, a.z - raised_, b.s, b.z - raised_);
  if (!(least.clearance < 0)) return std::nullopt;
  const Point low{least.distance, a.z + (least.distance - a.s) / (b.s - a.s) * (b.z - a.z)};
  for (const double s : {root(a, low), root(low, b)})
    if (!isAtAnEnd(s)) return s;
  return std::nullopt;
}

std::optional<double> LineCrossing::upright(Vec2 place, const std::array<Vec3, 3>& corners) const {
  const auto cut = cutUpright(place, {1, 0}, corners);
  if (!cut) return std::nullopt;
  Vec2 a = (*cut)[0], b = (*cut)[1];
  if ((a.x >= 0) == (b.x >= 0)) return std::nullopt;
  if (a.x >= 0) std::swap(a, b);
  const double metric = a.y + a.x / (a.x - b.x) * (b.y - a.y);
  const double z = metric / frame_.scale.z + frame_.origin.z,
               end = kSightEndMetres / line_.heightUnitMetres();
  const auto [low, high] = std::minmax({line_.fromHeight(), line_.toHeight()});
  return z > low + end && z < high - end ? std::optional(z) : std::nullopt;
}

}  // namespace arete
