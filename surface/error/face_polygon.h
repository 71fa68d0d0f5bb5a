// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/vec.h"

namespace arete {

/// A point of a face (a, b, c): a + (b - a) u / kOne + (c - a) v / kOne, where u + v <= kOne but for
/// rounding.
struct FacePoint {
  static constexpr std::uint32_t kOne = std::uint32_t{1} << 30;
  std::uint32_t u = 0, v = 0;
  auto operator<=>(const FacePoint&) const = default;
};

/// Where a point of a face is.
inline Vec3 placeOf(const FacePoint& p, const SpaceTriangle& face) {
  constexpr double kUnit = 1.0 / FacePoint::kOne;
  // Corners are themselves, to the bit.
  if (p.v == 0) {
    if (p.u == 0) return face[0];
    if (p.u == FacePoint::kOne) return face[1];
  } else if (p.u == 0 && p.v == FacePoint::kOne) {
    return face[2];
  }
  return face[0] + (face[1] - face[0]) * (p.u * kUnit) + (face[2] - face[0]) * (p.v * kUnit);
}

/// The shares of the corners of a face at a point of it.
inline std::array<double, 3> sharesOf(const FacePoint& p) {
  constexpr double kUnit = 1.0 / FacePoint::kOne;
  const double u = p.u * kUnit, v = p.v * kUnit;
  return {1 - u - v, u, v};
}

/// Corners of a convex polygon in a face, counter-clockwise in (u, v).
using FacePolygon = std::vector<FacePoint>;

/// The corners of a whole face.
std::span<const FacePoint> wholeFace();
bool isWholeFace(std::span<const FacePoint> polygon);

/// The smallest convex polygon that contains all points: `points` receives its corners, from the least one
/// on. Exact. Points that are all on one line leave two corners, or one. O(n log n).
void takeConvexHull(FacePolygon& points);

/// Twice the area, in units of 1 / kOne^2. Exact below 2^62.
std::int64_t twiceArea(std::span<const FacePoint> polygon);

/// Cuts a convex polygon where a linear function is zero: `below` receives the part where it is negative,
/// `above` the part where it is positive; corners at zero belong to both. New corners are rounded to the
/// grid of FacePoint, the same in both parts.
/// @param heights of the function at the corners.
void cut(std::span<const FacePoint> polygon, std::span<const double> heights, FacePolygon& below,
         FacePolygon& above);

}  // namespace arete
