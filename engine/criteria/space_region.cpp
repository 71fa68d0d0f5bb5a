// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle and a box are apart if an axis separates them [AkenineMoller2001]: one of the box, the
// triangle's normal, or a cross product of an axis and a side. The distance between the two is then that of a
// corner from the other, or of two edges.
#include "engine/criteria/space_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_gap.h"

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

/// The distance between a box and a triangle that do not meet.
double gapBetween(const Vec3& low, const Vec3& high, const SpaceTriangle& t) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : t)
    least =
        std::min(least, squaredDistance(p, {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y),
                                            std::clamp(p.z, low.z, high.z)}));
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                  (i & 4) != 0 ? high.z : low.z};
  for (std::size_t i = 0; i < 8; ++i) {
    least = std::min(least, squaredDistance(corners[i], nearestOnTriangle(corners[i], t)));
    for (const std::size_t axis : {1u, 2u, 4u}) {
      if ((i & axis) != 0) continue;
      for (std::size_t k = 0; k < 3; ++k)
        least = std::min(least, squaredSegmentGap(corners[i], corners[i | axis], t[k], t[(k + 1) % 3]));
    }
  }
  return std::sqrt(least);
}

/// A distance with what rounding may have added to one of the same size, at coordinates of this size.
double widened(double distance, double largest) {
  return distance * kWiden + 1e-14 * largest;
}

double largestOf(const Vec3& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

}  // namespace

bool BoxRegion::meetsTriangle(const SpaceTriangle& t, double widening) const {
  const double reach = widened(widening, std::max({largestOf(low_), largestOf(high_), largestOf(t[0]),
                                                   largestOf(t[1]), largestOf(t[2])}));
  const auto isBeyond = [&](double a, double b, double c, double from, double to) {
    return std::min({a, b, c}) > to + reach || std::max({a, b, c}) < from - reach;
  };
  if (isBeyond(t[0].x, t[1].x, t[2].x, low_.x, high_.x) ||
      isBeyond(t[0].y, t[1].y, t[2].y, low_.y, high_.y) || isBeyond(t[0].z, t[1].z, t[2].z, low_.z, high_.z))
    return false;
  if (meetsBox(low_ / 2 + high_ / 2, high_ / 2 - low_ / 2, t)) return true;
  return widening > 0 && gapBetween(low_, high_, t) <= reach;
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

bool BallRegion::meetsTriangle(const SpaceTriangle& t, double widening) const {
  const double largest = std::max({largestOf(centre_), largestOf(t[0]), largestOf(t[1]), largestOf(t[2])});
  return distanceToTriangle(centre_, t) <= widened(radius_ + widening, largest);
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
  return !region_->meetsTriangle({mt.position(VertexId(corners[0])), mt.position(VertexId(corners[1])),
                                  mt.position(VertexId(corners[2]))},
                                 error);
}

}  // namespace arete
