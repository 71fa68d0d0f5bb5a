// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places are told from the apex, so all numbers are as small as the hole, and floats have digits enough to
// tell most points. An edge's function is a sum of terms of 8 reach.x reach.y at most, each with no more
// than five roundings; the plane's likewise, of what its slopes rise within reach, and of heights. What they
// can be off by is below the margins.
//
// The plane's slopes are found in doubles. Where the terms of the triangle's area all but cancel they mean
// little, and no height is told: every point that may be covered is found. Where reaches are so large or so
// small that products of floats are none, nothing is told.
#include "terrain/error/conflict_lists.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace arete {
namespace {

using Four = float __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4;
constexpr float kNothing = std::numeric_limits<float>::infinity();  // is told: of a margin

Four all(float x) {
  return Four{x, x, x, x};
}
Four load(const float* x) {
  Four four;
  std::memcpy(&four, x, sizeof four);
  return four;
}

/// Whether products of two numbers up to these can be told in floats, and so can their sums.
bool isTold(double reach) {
  return reach > 0x1p-40 && reach < 0x1p40;
}

}  // namespace

void ConflictLists::grow() {
  const std::size_t capacity = std::max<std::size_t>(64, 2 * points_.size());
  points_.resize(capacity);
  for (std::vector<float>* of : {&x_, &y_, &z_}) of->resize(capacity + kLanes);
}

ConflictLists::Triangle::Triangle(const ConflictLists& below, const Vec3& a, const Vec3& b, const Vec3& c)
    : below_(below) {
  edges_[0] = leftOf(a, b);
  edges_[1] = leftOf(b, c);
  edges_[2] = leftOf(c, a);
  const Vec3& reach = below.reach_;
  const bool isPlanTold = isTold(reach.x) && isTold(reach.y);
  edgeMargin_ = isPlanTold ? static_cast<float>(0x1p-17 * reach.x * reach.y) : kNothing;

  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, dzB = b.z - a.z,
               dzC = c.z - a.z;
  const double forth = bx * cy, back = by * cx, area = forth - back;
  plane_ = {0, 0, 0};
  planeMargin_ = kNothing;
  constexpr double kTrusted = 0x1p-20, kVanishing = 0x1p-900;  // small products may have lost their digits
  if (!(area > kTrusted * (std::abs(forth) + std::abs(back)) + kVanishing)) return;
  const double slopeX = (dzB * cy - dzC * by) / area, slopeY = (dzC * bx - dzB * cx) / area;
  const double steepX = (std::abs(dzB * cy) + std::abs(dzC * by)) / area,
               steepY = (std::abs(dzC * bx) + std::abs(dzB * cx)) / area;
  const double most = steepX * reach.x + steepY * reach.y + reach.z;
  if (most == 0) {
    planeMargin_ = 0;  // level, and all points on it
  } else if (isPlanTold && isTold(most)) {
    const double atApex =
        (a.z - below.apex_.z) - slopeX * (a.x - below.apex_.x) - slopeY * (a.y - below.apex_.y);
    plane_ = {static_cast<float>(atApex), static_cast<float>(slopeX), static_cast<float>(slopeY)};
    planeMargin_ = static_cast<float>(0x1p-18 * most);
  }
}

ConflictLists::Triangle::Linear ConflictLists::Triangle::leftOf(const Vec3& from, const Vec3& to) const {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double x = from.x - below_.apex_.x, y = from.y - below_.apex_.y;
  return {static_cast<float>(dy * x - dx * y), static_cast<float>(-dy), static_cast<float>(dx)};
}

ConflictLists::Found ConflictLists::Triangle::next(std::size_t from, double above, double below) const {
  const auto at = [](const Linear& f, Four x, Four y) {
    return all(f.atApex) + all(f.alongX) * x + all(f.alongY) * y;
  };
  using Mask = decltype(Four{} < Four{});
  const Four mostAbove = all(static_cast<float>(above * (1 - 0x1p-22)) - planeMargin_),
             leastBelow = all(planeMargin_ - static_cast<float>(below * (1 - 0x1p-22))),
             outside = all(-edgeMargin_);
  const std::size_t size = below_.size_;
  for (std::size_t k = from & ~(kLanes - 1); k < size; k += kLanes) {
    const Four x = load(&below_.x_[k]), y = load(&below_.y_[k]);
    const Four e0 = at(edges_[0], x, y), e1 = at(edges_[1], x, y), e2 = at(edges_[2], x, y);
    const Four difference = at(plane_, x, y) - load(&below_.z_[k]);
    // What is no number decides nothing.
    const Mask no = (e0 < outside) | (e1 < outside) | (e2 < outside) |
                    ((difference <= mostAbove) & (difference >= leastBelow));
    std::uint64_t halves[2];
    static_assert(sizeof halves == sizeof no);
    std::memcpy(halves, &no, sizeof no);
    if ((halves[0] & halves[1]) == ~std::uint64_t{0}) continue;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (no[i] != 0 || k + i < from || k + i >= size) continue;
      return {k + i, e0[i] > edgeMargin_ && e1[i] > edgeMargin_ && e2[i] > edgeMargin_};
    }
  }
  return {size, false};
}

ConflictLists::Found ConflictLists::Triangle::nextCovered(std::size_t from) const {
  constexpr double kAll = -std::numeric_limits<double>::infinity();
  return next(from, kAll, kAll);
}

}  // namespace arete
