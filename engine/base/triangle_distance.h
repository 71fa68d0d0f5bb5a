// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/base/vec.h"

namespace arete {

/// Distance from p to the nearest point of the triangle abc in space: to the foot of the perpendicular where
/// it falls inside, to the nearest edge otherwise. A triangle without area is its edges.
inline double distanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto minus = [](const Vec3& u, const Vec3& v) { return Vec3{u.x - v.x, u.y - v.y, u.z - v.z}; };
  const auto dot = [](const Vec3& u, const Vec3& v) { return u.x * v.x + u.y * v.y + u.z * v.z; };
  const auto length = [&](const Vec3& u) { return std::sqrt(dot(u, u)); };
  const auto toSegment = [&](const Vec3& u, const Vec3& v) {
    const Vec3 d = minus(v, u), w = minus(p, u);
    const double squared = dot(d, d);
    const double t = squared > 0 ? std::clamp(dot(w, d) / squared, 0.0, 1.0) : 0;
    return length({w.x - t * d.x, w.y - t * d.y, w.z - t * d.z});
  };
  const Vec3 ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const Vec3 normal{ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x};
  const double area = dot(normal, normal);
  if (area > 0) {
    // Barycentric coordinates of the foot of p on the plane.
    const auto turn = [&](const Vec3& u, const Vec3& v) {
      return dot(normal, {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x});
    };
    const double v = turn(ap, ac) / area, w = turn(ab, ap) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) return std::abs(dot(ap, normal)) / std::sqrt(area);
  }
  return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
}

}  // namespace arete
