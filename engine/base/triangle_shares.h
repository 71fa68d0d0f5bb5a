// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

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

}  // namespace arete
