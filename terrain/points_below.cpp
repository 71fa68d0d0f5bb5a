// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places are told from the apex, so all numbers are as small as the hole. A place so told has one rounding,
// an edge's function a dozen, all of terms no larger than 8 reach.x reach.y: their sum is far below the
// margin. The plane's slopes are found from the corners' own coordinates; where the terms of the triangle's
// area all but cancel they mean little, and no height is told: every point that may be covered is found.
#include "terrain/points_below.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/two_doubles.h"

namespace arete {

void PointsBelow::grow() {
  const std::size_t capacity = std::max<std::size_t>(64, 2 * points_.size());
  points_.resize(capacity);
  for (std::vector<double>* of : {&x_, &y_, &z_}) of->resize(capacity + 1);
}

PointsBelow::Triangle::Triangle(const PointsBelow& below, const Vec3& a, const Vec3& b, const Vec3& c)
    : below_(below) {
  edges_[0] = leftOf(a, b);
  edges_[1] = leftOf(b, c);
  edges_[2] = leftOf(c, a);
  const Vec3& reach = below.reach_;
  edgeMargin_ = 0x1p-45 * reach.x * reach.y;

  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, dzB = b.z - a.z,
               dzC = c.z - a.z;
  const double forth = bx * cy, back = by * cx, area = forth - back;
  constexpr double kTrusted = 0x1p-20;
  if (area > kTrusted * (std::abs(forth) + std::abs(back))) {
    const double slopeX = (dzB * cy - dzC * by) / area, slopeY = (dzC * bx - dzB * cx) / area;
    plane_ = {(a.z - below.apex_.z) - slopeX * (a.x - below.apex_.x) - slopeY * (a.y - below.apex_.y), slopeX,
              slopeY};
    const double steepX = (std::abs(dzB * cy) + std::abs(dzC * by)) / area,
                 steepY = (std::abs(dzC * bx) + std::abs(dzB * cx)) / area;
    planeMargin_ = 0x1p-28 * (steepX * reach.x + steepY * reach.y) + 0x1p-48 * reach.z;
  } else {
    plane_ = {0, 0, 0};
    planeMargin_ = std::numeric_limits<double>::infinity();
  }
}

PointsBelow::Triangle::Linear PointsBelow::Triangle::leftOf(const Vec3& from, const Vec3& to) const {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double x = from.x - below_.apex_.x, y = from.y - below_.apex_.y;
  return {dy * x - dx * y, -dy, dx};
}

PointsBelow::Found PointsBelow::Triangle::next(std::size_t from, double above, double below) const {
  const auto at = [](const Linear& f, Two x, Two y) {
    return both(f.atApex) + both(f.alongX) * x + both(f.alongY) * y;
  };
  using Mask = decltype(Two{} < Two{});
  const Two mostAbove = both(above - planeMargin_), leastBelow = both(planeMargin_ - below),
            outside = both(-edgeMargin_);
  const std::size_t size = below_.size_;
  for (std::size_t k = from & ~std::size_t{1}; k < size; k += 2) {
    const Two x = load(&below_.x_[k]), y = load(&below_.y_[k]);
    const Two e0 = at(edges_[0], x, y), e1 = at(edges_[1], x, y), e2 = at(edges_[2], x, y);
    const Two difference = at(plane_, x, y) - load(&below_.z_[k]);
    // What is no number decides nothing.
    const Mask no = (e0 < outside) | (e1 < outside) | (e2 < outside) |
                    ((difference <= mostAbove) & (difference >= leastBelow));
    if ((no[0] & no[1]) != 0) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      if (no[i] != 0 || k + i < from || k + i >= size) continue;
      return {k + i, e0[i] > edgeMargin_ && e1[i] > edgeMargin_ && e2[i] > edgeMargin_};
    }
  }
  return {size, false};
}

PointsBelow::Found PointsBelow::Triangle::nextCovered(std::size_t from) const {
  constexpr double kAll = -std::numeric_limits<double>::infinity();
  return next(from, kAll, kAll);
}

}  // namespace arete
