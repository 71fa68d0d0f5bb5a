// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "engine/base/nearest_on_triangle.h"
#include "engine/mt/hole_limit.h"

namespace arete {

/// The distances of a point from several triangles at once: those of nearestOnTriangle() but for rounding,
/// and the same numbers on every processor.
class FloorDistance {
 public:
  static constexpr int kMost = 32;
  static_assert(kMost >= kMaxHoleCorners - 1, "a floor, and the triangles of a star");
  using Squares = std::array<double, kMost>;

  void clear() { size_ = 0; }
  /// Precondition: size() < kMost.
  void add(const SpaceTriangle& t);
  int size() const { return size_; }
  /// (b - a) x (c - a) of triangle i, or zero (areaNormal()).
  Vec3 normal(int i) const { return {normal_[0][i], normal_[1][i], normal_[2][i]}; }

  /// The squared distances, by triangle. Elements from size() on are undefined.
  void squares(const Vec3& p, Squares& to) const;
  /// The least of them.
  double nearest(const Vec3& p) const;

 private:
  using Lanes = std::array<double, kMost>;

  int size_ = 0;
  // By axis, of corner or side i: a triangle in each lane.
  std::array<std::array<Lanes, 3>, 3> corner_{}, side_{}, inward_{};
  std::array<Lanes, 3> normal_{}, perSide_{};
  Lanes perNormal_{};
  /// What the height above a side's plane has to reach on the inner side: infinite without an area.
  Lanes inside_{};
};

}  // namespace arete
