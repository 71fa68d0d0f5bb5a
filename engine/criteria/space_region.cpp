// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle and a box are apart if an axis separates them [AkenineMoller2001]: one of the box, the
// triangle's normal, or a cross product of an axis and a side.
#include "engine/criteria/space_region.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/nearest_on_triangle.h"

namespace arete {
namespace {

constexpr double kWiden = 1 + 1e-9;

bool meetsBox(const Vec3& centre, const Vec3& half, const SpaceTriangle& t) {
  const SpaceTriangle at{t[0] - centre, t[1] - centre, t[2] - centre};
  const auto isApart = [&](const Vec3& axis) {
    const double p = dot(axis, at[0]), q = dot(axis, at[1]), r = dot(axis, at[2]);
    const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    const double rounding = 1e-12 * (std::abs(p) + std::abs(q) + std::abs(r) + reach);
    return std::min({p, q, r}) > reach + rounding || std::max({p, q, r}) < -reach - rounding;
  };
  constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (const Vec3& axis : kAxes)
    if (isApart(axis)) return false;
  if (isApart(cross(at[1] - at[0], at[2] - at[0]))) return false;
  for (const Vec3& axis : kAxes)
    for (std::size_t i = 0; i < 3; ++i)
      if (isApart(cross(axis, at[(i + 1) % 3] - at[i]))) return false;
  return true;
}

}  // namespace

bool SpaceRegion::meetsTriangle(const Vec3& a, const Vec3& b, const Vec3& c) const {
  if (shape == Shape::ball) return distanceToTriangle(centre, {a, b, c}) <= radius;
  return meetsBox(low / 2 + high / 2, high / 2 - low / 2, {a, b, c});
}

bool SpaceRegion::meetsBall(const Vec3& c, double r) const {
  if (shape == Shape::ball) return norm(c - centre) <= (r + radius) * kWiden;
  const auto outside = [](double x, double from, double to) { return std::max({from - x, 0.0, x - to}); };
  const Vec3 away{outside(c.x, low.x, high.x), outside(c.y, low.y, high.y), outside(c.z, low.z, high.z)};
  return norm(away) <= r * kWiden;
}

bool SpaceRegion::holdsBall(const Vec3& c, double r) const {
  const double wide = r * kWiden;
  if (shape == Shape::ball) return norm(c - centre) + wide <= radius;
  return c.x - wide >= low.x && c.x + wide <= high.x && c.y - wide >= low.y && c.y + wide <= high.y &&
         c.z - wide >= low.z && c.z + wide <= high.z;
}

bool SpaceRegionError::isFineEnough(const MultiTriangulation& mt, TriangleId t,
                                    const Corners& corners) const {
  const double error = mt.error(t);
  if (error <= insideError_) return true;
  if (error > outsideError_) return false;
  return !region_.meetsTriangle(mt.position(VertexId(corners[0])), mt.position(VertexId(corners[1])),
                                mt.position(VertexId(corners[2])));
}

}  // namespace arete
