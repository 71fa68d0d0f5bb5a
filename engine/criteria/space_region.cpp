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

bool BoxRegion::meetsTriangle(const Vec3& a, const Vec3& b, const Vec3& c) const {
  return meetsBox(low_ / 2 + high_ / 2, high_ / 2 - low_ / 2, {a, b, c});
}

bool BoxRegion::meetsBall(const Vec3& c, double r) const {
  const auto outside = [](double x, double from, double to) { return std::max({from - x, 0.0, x - to}); };
  const Vec3 away{outside(c.x, low_.x, high_.x), outside(c.y, low_.y, high_.y),
                  outside(c.z, low_.z, high_.z)};
  return norm(away) <= r * kWiden;
}

bool BoxRegion::holdsBall(const Vec3& c, double r) const {
  const double wide = r * kWiden;
  return c.x - wide >= low_.x && c.x + wide <= high_.x && c.y - wide >= low_.y && c.y + wide <= high_.y &&
         c.z - wide >= low_.z && c.z + wide <= high_.z;
}

bool BallRegion::meetsTriangle(const Vec3& a, const Vec3& b, const Vec3& c) const {
  return distanceToTriangle(centre_, {a, b, c}) <= radius_;
}

bool BallRegion::meetsBall(const Vec3& c, double r) const {
  return norm(c - centre_) <= (r + radius_) * kWiden;
}

bool BallRegion::holdsBall(const Vec3& c, double r) const {
  return norm(c - centre_) + r * kWiden <= radius_;
}

bool SpaceRegionError::isFineEnough(const MultiTriangulation& mt, TriangleId t,
                                    const Corners& corners) const {
  const double error = mt.error(t);
  if (error <= insideError_) return true;
  if (error > outsideError_) return false;
  return !region_->meetsTriangle(mt.position(VertexId(corners[0])), mt.position(VertexId(corners[1])),
                                 mt.position(VertexId(corners[2])));
}

}  // namespace arete
