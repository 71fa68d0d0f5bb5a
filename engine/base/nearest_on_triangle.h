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

/// Thinner than this fraction of its longest side, a triangle has no plane that doubles can tell: it counts
/// as without area, and distances to it are those to its sides, wrong by less than that height.
inline constexpr double kThinnestTriangle = 1e-9;

/// (b - a) x (c - a), twice the area long; zero for a triangle without area (kThinnestTriangle).
inline Vec3 areaNormal(const SpaceTriangle& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], bc = t[2] - t[1];
  const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  const Vec3 normal = cross(ab, ac);
  const double least = kThinnestTriangle * longest;
  return dot(normal, normal) > least * least ? normal : Vec3{};
}

/// The point of a triangle that is nearest to `p`: over the triangle its foot on the plane, else on a side
/// that `p` lies beyond (the nearest point of a convex set always is on one of those). Well-defined for
/// triangles that are a segment or a point. O(1).
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
  // Reckoned from the nearest corner, a corner is exactly on its own triangle, however thin that is.
  const Vec3& corner = *std::ranges::min_element(t, {}, [&](const Vec3& c) { return squaredDistance(p, c); });
  return p + (-dot(normal, p - corner) / squared) * normal;
}

/// The distance from `p` to the nearest point of a triangle. O(1).
inline double distanceToTriangle(const Vec3& p, const SpaceTriangle& t) {
  return std::sqrt(squaredDistance(p, nearestOnTriangle(p, t)));
}

}  // namespace arete
