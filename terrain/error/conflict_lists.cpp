// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coordinates count from the apex, so all numbers are as small as the hole and floats have enough digits to
// decide most points. The function of an edge is a sum of terms of at most 8 reach.x reach.y, each with no
// more than five roundings; likewise the plane, whose terms are bounded by the rise of its slopes within the
// reach and by the heights. The margins exceed the rounding errors.
//
// The slopes of the plane are computed in doubles. Where the terms of the triangle's area almost cancel, the
// slopes are not reliable; then the margin of the plane is infinite, and every point that may be covered is
// found. Where the reach is so large or so small that products of floats overflow or underflow, both margins
// are infinite and every point is found.
#include "terrain/error/conflict_lists.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace arete {
namespace {

using Four = float __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4;
constexpr float kUndecided = std::numeric_limits<float>::infinity();  // a margin that decides nothing

Four broadcastFour(float x) {
  return Four{x, x, x, x};
}
Four load(const float* x) {
  Four four;
  std::memcpy(&four, x, sizeof four);
  return four;
}

/// Whether products of two numbers up to `reach`, and their sums, neither overflow nor underflow in floats.
bool isInFloatRange(double reach) {
  return reach > 0x1p-40 && reach < 0x1p40;
}

}  // namespace

void ConflictLists::grow() {
  const std::size_t capacity = std::max<std::size_t>(64, 2 * points_.size());
  points_.resize(capacity);
  for (std::vector<float>* coordinates : {&x_, &y_, &z_}) coordinates->resize(capacity + kLanes);
}

ConflictLists::Triangle::Triangle(const ConflictLists& lists, const Vec3& a, const Vec3& b, const Vec3& c)
    : lists_(lists) {
  edges_[0] = leftOf(a, b);
  edges_[1] = leftOf(b, c);
  edges_[2] = leftOf(c, a);
  const Vec3& reach = lists.reach_;
  const bool isPlanInRange = isInFloatRange(reach.x) && isInFloatRange(reach.y);
  edgeMargin_ = isPlanInRange ? static_cast<float>(0x1p-17 * reach.x * reach.y) : kUndecided;

  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, dzB = b.z - a.z,
               dzC = c.z - a.z;
  const double left = bx * cy, right = by * cx, area = left - right;
  plane_ = {0, 0, 0};
  planeMargin_ = kUndecided;
  constexpr double kReliable = 0x1p-20, kUnderflow = 0x1p-900;  // smaller products may be denormal
  if (!(area > kReliable * (std::abs(left) + std::abs(right)) + kUnderflow)) return;
  const double slopeX = (dzB * cy - dzC * by) / area, slopeY = (dzC * bx - dzB * cx) / area;
  const double steepX = (std::abs(dzB * cy) + std::abs(dzC * by)) / area,
               steepY = (std::abs(dzC * bx) + std::abs(dzB * cx)) / area;
  const double most = steepX * reach.x + steepY * reach.y + reach.z;
  if (most == 0) {
    planeMargin_ = 0;  // a level triangle, and all points on it
  } else if (isPlanInRange && isInFloatRange(most)) {
    const double atApex =
        (a.z - lists.apex_.z) - slopeX * (a.x - lists.apex_.x) - slopeY * (a.y - lists.apex_.y);
    plane_ = {static_cast<float>(atApex), static_cast<float>(slopeX), static_cast<float>(slopeY)};
    planeMargin_ = static_cast<float>(0x1p-18 * most);
  }
}

ConflictLists::Triangle::Linear ConflictLists::Triangle::leftOf(const Vec3& from, const Vec3& to) const {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double x = from.x - lists_.apex_.x, y = from.y - lists_.apex_.y;
  return {static_cast<float>(dy * x - dx * y), static_cast<float>(-dy), static_cast<float>(dx)};
}

ConflictLists::Found ConflictLists::Triangle::next(std::size_t from, double above, double below) const {
  const auto at = [](const Linear& f, Four x, Four y) {
    return broadcastFour(f.atApex) + broadcastFour(f.alongX) * x + broadcastFour(f.alongY) * y;
  };
  using Mask = decltype(Four{} < Four{});
  const Four mostAbove = broadcastFour(static_cast<float>(above * (1 - 0x1p-22)) - planeMargin_),
             leastBelow = broadcastFour(planeMargin_ - static_cast<float>(below * (1 - 0x1p-22))),
             outside = broadcastFour(-edgeMargin_);
  const std::size_t size = lists_.size_;
  for (std::size_t k = from & ~(kLanes - 1); k < size; k += kLanes) {
    const Four x = load(&lists_.x_[k]), y = load(&lists_.y_[k]);
    const Four e0 = at(edges_[0], x, y), e1 = at(edges_[1], x, y), e2 = at(edges_[2], x, y);
    const Four difference = at(plane_, x, y) - load(&lists_.z_[k]);
    // Comparisons with NaN are false: the point is not excluded.
    const Mask excluded = (e0 < outside) | (e1 < outside) | (e2 < outside) |
                          ((difference <= mostAbove) & (difference >= leastBelow));
    std::uint64_t halves[2];
    static_assert(sizeof halves == sizeof excluded);
    std::memcpy(halves, &excluded, sizeof excluded);
    if ((halves[0] & halves[1]) == ~std::uint64_t{0}) continue;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (excluded[i] != 0 || k + i < from || k + i >= size) continue;
      return {k + i, e0[i] > edgeMargin_ && e1[i] > edgeMargin_ && e2[i] > edgeMargin_};
    }
  }
  return {size, false};
}

ConflictLists::Found ConflictLists::Triangle::nextCovered(std::size_t from) const {
  constexpr double kAnyHeight = -std::numeric_limits<double>::infinity();
  return next(from, kAnyHeight, kAnyHeight);
}

}  // namespace arete
