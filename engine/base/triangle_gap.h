// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/vec.h"

namespace arete {

/// The squared distance between the segments p-q and r-s, which may be points. Rounding makes it too large by
/// a few ulp of the coordinates, never too small by more. O(1).
inline double squaredSegmentGap(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const auto toSegment = [](const Vec3& x, const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    const double length = dot(along, along);
    const double at = length > 0 ? std::clamp(dot(x - from, along) / length, 0.0, 1.0) : 0;
    return squaredDistance(x, from + at * along);
  };
  double least = std::min({toSegment(p, r, s), toSegment(q, r, s), toSegment(r, p, q), toSegment(s, p, q)});
  // Between inner points: where the common perpendicular of both lines is.
  const Vec3 u = q - p, v = s - r, w = r - p, across = cross(u, v);
  const double squared = dot(across, across);
  if (!(squared > 0)) return least;
  const double a = dot(cross(w, v), across) / squared, b = dot(cross(w, u), across) / squared;
  if (a > 0 && a < 1 && b > 0 && b < 1) least = std::min(least, squaredDistance(p + a * u, r + b * v));
  return least;
}

/// The distance between two triangles that do not meet; of two that do, some distance. O(1).
inline double gapBetween(const SpaceTriangle& a, const SpaceTriangle& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, squaredDistance(a[i], nearestOnTriangle(a[i], b)));
    least = std::min(least, squaredDistance(b[i], nearestOnTriangle(b[i], a)));
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, squaredSegmentGap(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return std::sqrt(least);
}

}  // namespace arete
