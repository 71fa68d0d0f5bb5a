// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/vec.h"

namespace arete {

/// The shares of a triangle's corners at a point of it: each at least 0, their sum 1 but for rounding.
/// Precondition: the triangle has an area.
inline std::array<double, 3> sharesAt(const Vec3& p, const SpaceTriangle& t) {
  const auto& [a, b, c] = t;
  const Vec3 n = cross(b - a, c - a);
  const double whole = dot(n, n);
  std::array<double, 3> shares = {dot(cross(c - b, p - b), n) / whole, dot(cross(a - c, p - c), n) / whole,
                                  dot(cross(b - a, p - a), n) / whole};
  double sum = 0;
  for (double& s : shares) sum += s = std::max(0.0, s);
  for (double& s : shares) s /= sum;
  return shares;
}

/// The shares of a triangle's corners at its point that is nearest to `p`, also of triangles that are a
/// segment or a point: then of the ends of the nearest side. O(1).
inline std::array<double, 3> nearestShares(const Vec3& p, const SpaceTriangle& t) {
  const Vec3 q = nearestOnTriangle(p, t), normal = areaNormal(t);
  if (dot(normal, normal) > 0) return sharesAt(q, t);
  std::array<double, 3> shares{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vec3 side = t[j] - t[i];
    const double length = dot(side, side);
    const double at = length > 0 ? std::clamp(dot(side, q - t[i]) / length, 0.0, 1.0) : 0;
    const double distance = squaredDistance(q, t[i] + at * side);
    if (!(distance < least)) continue;
    least = distance;
    shares = {};
    shares[i] = 1 - at;
    shares[j] = at;
  }
  return shares;
}

}  // namespace arete
