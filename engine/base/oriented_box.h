// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "engine/base/box3.h"
#include "engine/base/nearest_on_triangle.h"
#include "engine/base/vec.h"

namespace arete {

/// A box of any direction: bounds along three unit vectors that stand on each other.
struct OrientedBox {
  std::array<Vec3, 3> axes{};
  std::array<double, 3> low{}, high{};

  /// From `p`; 0 inside. O(1).
  double squaredDistance(const Vec3& p) const {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = dot(axes[k], p), beyond = std::max({low[k] - at, 0.0, at - high[k]});
      squared += beyond * beyond;
    }
    return squared;
  }
};

/// The box of some triangles along their longest side and their planes, where it has less than a quarter of
/// the surface of `box`, the plain one; so it is for long triangles that lie aslant side by side, as around a
/// vertex of many. It is wider than they are by what the rounding of products may hide. Nothing where the
/// longest side is less than half of the plain box's diagonal, which needs one pass. O(triangles).
inline std::optional<OrientedBox> orientedBoxOf(std::span<const SpaceTriangle> triangles, const Box3& box) {
  constexpr double kLeastSide = 0.5, kMostSurface = 0.25;
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  Vec3 along{0, 0, 0}, normal{0, 0, 0};
  double longest = 0;
  for (const SpaceTriangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 side = t[(i + 1) % 3] - t[i];
      if (!(dot(side, side) > longest)) continue;
      longest = dot(side, side);
      along = side;
    }
  const double length = std::sqrt(longest);
  if (!(length > 0) || !(length >= kLeastSide * box.diagonal())) return std::nullopt;
  for (const SpaceTriangle& t : triangles) {
    const Vec3 one = cross(t[1] - t[0], t[2] - t[0]);
    normal = dot(one, normal) < 0 ? normal - one : normal + one;
  }
  OrientedBox found;
  found.axes[0] = along / length;
  normal = normal - dot(normal, found.axes[0]) * found.axes[0];
  if (!(norm(normal) > 1e-9 * longest)) {  // on a line: any direction beside it
    const Vec3 a{std::fabs(along.x), std::fabs(along.y), std::fabs(along.z)};
    normal = cross(found.axes[0], a.x <= a.y && a.x <= a.z ? Vec3{1, 0, 0}
                                  : a.y <= a.z             ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1});
  }
  found.axes[1] = normal / norm(normal);
  found.axes[2] = cross(found.axes[0], found.axes[1]);
  double largest = 0;
  for (const Vec3& p : {box.low, box.high})
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  const double rounding = kRounding * largest;
  std::array<double, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    found.low[k] = std::numeric_limits<double>::infinity();
    found.high[k] = -found.low[k];
    for (const SpaceTriangle& t : triangles)
      for (const Vec3& p : t) {
        const double at = dot(found.axes[k], p);
        found.low[k] = std::min(found.low[k], at);
        found.high[k] = std::max(found.high[k], at);
      }
    sides[k] = found.high[k] - found.low[k];
    found.low[k] -= rounding;
    found.high[k] += rounding;
  }
  const auto surface = [](double x, double y, double z) { return x * y + y * z + z * x; };
  const Vec3 plain = box.high - box.low;
  if (!(surface(sides[0], sides[1], sides[2]) < kMostSurface * surface(plain.x, plain.y, plain.z)))
    return std::nullopt;
  return found;
}

}  // namespace arete
