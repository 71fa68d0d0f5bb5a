// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/vec.h"

namespace arete {

constexpr double squaredDistance(const Vec3& a, const Vec3& b) {
  return dot(a - b, a - b);
}

/// A triangle in space.
using SpaceTriangle = std::array<Vec3, 3>;

/// A triangle whose height is below this fraction of its longest side counts as degenerate: doubles cannot
/// represent its plane. Distances to it are those to its sides, and err by less than its height.
inline constexpr double kThinnestTriangle = 1e-9;

/// The normal (b - a) x (c - a), whose length is twice the area; zero for a degenerate triangle
/// (kThinnestTriangle).
inline Vec3 areaNormal(const SpaceTriangle& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], bc = t[2] - t[1];
  const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  const Vec3 normal = cross(ab, ac);
  const double least = kThinnestTriangle * longest;
  return dot(normal, normal) > least * least ? normal : Vec3{};
}

/// The point of a triangle that is nearest to `p`: the foot of the perpendicular if that lies in the
/// triangle, else the nearest point of the sides that `p` lies beyond. Also defined for triangles that are a
/// segment or a point. O(1).
inline Vec3 nearestOnTriangle(const Vec3& p, const SpaceTriangle& t) {
  const Vec3 normal = areaNormal(t);
  const double squared = dot(normal, normal);
  Vec3 nearest{};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 side = t[(i + 1) % 3] - t[i], toPoint = p - t[i];
    if (squared > 0 && dot(cross(normal, side), toPoint) >= 0) continue;
    const double length = dot(side, side);
    const double at = length > 0 ? std::clamp(dot(side, toPoint) / length, 0.0, 1.0) : 0;
    const Vec3 candidate = t[i] + at * side;
    const double distance = squaredDistance(p, candidate);
    if (distance < least) {
      nearest = candidate;
      least = distance;
    }
  }
  if (least < std::numeric_limits<double>::infinity()) return nearest;
  // Measured from the nearest corner, so that the distance of a corner from its own triangle is exactly 0.
  const Vec3& corner = *std::ranges::min_element(t, {}, [&](const Vec3& c) { return squaredDistance(p, c); });
  return p + (-dot(normal, p - corner) / squared) * normal;
}

/// The distance from `p` to the nearest point of a triangle. O(1).
inline double distanceToTriangle(const Vec3& p, const SpaceTriangle& t) {
  return std::sqrt(squaredDistance(p, nearestOnTriangle(p, t)));
}

}  // namespace arete
