// SPDX-License-Identifier: GPL-3.0-or-later
//
// A point is strictly inside when it is farther than the tolerance from every side, and outside when it is
// beyond one side by more than the tolerance. In the thin frame between the two:
//  - The distance is measured to the sides as segments, not as lines: at a sharp corner the frame's mitre
//    extends far beyond the triangle.
//  - Outside the triangle the height is that of its nearest point: the plane of a needle, continued, would be
//    far off.
//  - The part of a full turn that the triangle fills around the point is its angle at a corner, and half a
//  turn
//    on a side. In a conforming TIN the parts add up to one full turn at most, whatever the rounding: a point
//    counts as on a side within half the tolerance, and as strictly inside the neighbour only beyond the
//    whole tolerance.
//
// Angles are pseudo-angles (the position on the diamond |x| + |y| = 1): additive, opposite directions exactly
// half a turn apart, and free of trigonometry.
#include "terrain/measure/triangle.h"

#include <algorithm>
#include <cmath>

namespace arete::measuring {

namespace {

double diamondAngle(Vec2 d) {
  if (d.y >= 0) return d.x >= 0 ? d.y / (d.x + d.y) : 1 - d.x / (d.y - d.x);
  return d.x < 0 ? 2 - d.y / (-d.x - d.y) : 3 + d.x / (d.x - d.y);
}

float turnOf(Vec2 from, Vec2 to) {
  const double turn = diamondAngle(to) - diamondAngle(from);
  return static_cast<float>(turn < 0 ? turn + kFullTurn : turn);
}

double squaredDistance(Vec2 a, double x, double y) {
  return (a.x - x) * (a.x - x) + (a.y - y) * (a.y - y);
}

}  // namespace

float turnBetween(Vec2 around, Vec2 from, Vec2 to) {
  return turnOf({from.x - around.x, from.y - around.y}, {to.x - around.x, to.y - around.y});
}

bool PlanTriangle::set(const std::array<Vec2, 3>& corners, const std::array<double, 3>& heights,
                       double tolerance) {
  corner = corners;
  z = heights;
  const double cross = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                       (corner[1].y - corner[0].y) * (corner[2].x - corner[0].x);
  if (cross < 0) {
    std::swap(corner[1], corner[2]);
    std::swap(z[1], z[2]);
  }
  area2 = std::abs(cross);
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec2 &from = corner[(i + 1) % 3], &to = corner[(i + 2) % 3];
    side[i] = {to.x - from.x, to.y - from.y};
    length[i] = std::sqrt(side[i].x * side[i].x + side[i].y * side[i].y);
    longest = std::max(longest, length[i]);
  }
  return area2 > tolerance * longest;
}

float PlanTriangle::cornerTurn(int i) const {
  const Vec2 &out = side[(i + 2) % 3], &in = side[(i + 1) % 3];
  return turnOf(out, {-in.x, -in.y});
}

double PlanTriangle::heightFromWeights(double w1, double w2) const {
  // Relative to one corner, so that a flat triangle is flat to the last bit.
  return z[0] + (w1 * (z[1] - z[0]) + w2 * (z[2] - z[0])) / area2;
}

Contact PlanTriangle::contact(double x, double y, double tolerance) const {
  Contact result;
  std::array<double, 3> w;
  int near = 0, nearSide = 0;
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    w[i] = sideFunction(i, x, y);
    const double reach = tolerance * length[i];
    if (w[i] < -reach) return result;
    if (w[i] <= reach) {
      ++near;
      nearSide = i;
    }
    inside = inside && w[i] >= 0;
  }
  if (near == 0) {
    result.covers = result.strict = true;
    result.turn = kFullTurn;
    result.z = heightFromWeights(w[1], w[2]);
    return result;
  }

  // The point is in the frame: the nearest corner decides whether the triangle fills its angle there.
  int nearest = 0;
  double nearestSquared = squaredDistance(corner[0], x, y);
  for (int i = 1; i < 3; ++i)
    if (const double d = squaredDistance(corner[i], x, y); d < nearestSquared) {
      nearest = i;
      nearestSquared = d;
    }
  const bool atCorner = nearestSquared <= tolerance * tolerance;

  if (nearestSquared == 0) {
    result.covers = true;
    result.z = z[nearest];
  } else if (inside) {
    result.covers = true;
    result.z = heightFromWeights(w[1], w[2]);
  } else {
    // The nearest of the sides that the point is beyond gives the height.
    double best = tolerance * tolerance;
    for (int i = 0; i < 3; ++i) {
      if (w[i] >= 0) continue;
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      const double along =
          (side[i].x * (x - corner[a].x) + side[i].y * (y - corner[a].y)) / (length[i] * length[i]);
      const double t = std::clamp(along, 0.0, 1.0);
      const double d = squaredDistance({corner[a].x + t * side[i].x, corner[a].y + t * side[i].y}, x, y);
      if (d > best) continue;
      best = d;
      result.covers = true;
      result.z = z[a] + t * (z[b] - z[a]);
    }
  }
  if (!result.covers) return result;
  if (atCorner)
    result.turn = cornerTurn(nearest);
  else if (near == 1 && w[nearSide] >= -tolerance / 2 * length[nearSide])
    result.turn = kHalfTurn;
  return result;
}

}  // namespace arete::measuring
