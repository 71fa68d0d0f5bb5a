// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/vec.h"

namespace arete {

/// Three angles that turn a thing in a space whose z points up and in which it looks along y, in degrees: it
/// rolls, then pitches, then heads. Zeros leave it as it is.
struct Turn {
  double heading = 0;  ///< clockwise, seen from above
  double pitch = 0;    ///< its front upwards
  double roll = 0;     ///< its right side downwards
  bool operator==(const Turn&) const = default;
};

/// A turn, then a multiplication by one number, then a shift: it keeps angles and ratios of lengths. Made of
/// angles it never mirrors, and turns by right angles without rounding.
class Similarity {
 public:
  Similarity() = default;
  /// Precondition: all numbers are finite, scale > 0.
  Similarity(const Turn& turn, double scale, const Vec3& shift) : scale_(scale), shift_(shift) {
    const auto [sh, ch] = sineAndCosine(turn.heading);
    const auto [sp, cp] = sineAndCosine(turn.pitch);
    const auto [sr, cr] = sineAndCosine(turn.roll);
    const auto lifted = [&](const Vec3& p) { return Vec3{p.x, p.y * cp - p.z * sp, p.y * sp + p.z * cp}; };
    const auto headed = [&](const Vec3& p) { return Vec3{p.x * ch + p.y * sh, p.y * ch - p.x * sh, p.z}; };
    x_ = headed(lifted({cr, 0, -sr}));
    y_ = headed(lifted({0, 1, 0}));
    z_ = headed(lifted({sr, 0, cr}));
  }
  /// The axes' images, of length 1 and at right angles; left-handed ones mirror.
  explicit Similarity(const std::array<Vec3, 3>& axes, double scale, const Vec3& shift)
      : x_(axes[0]), y_(axes[1]), z_(axes[2]), scale_(scale), shift_(shift) {}

  /// Of a place.
  Vec3 operator()(const Vec3& p) const { return direction(p) * scale_ + shift_; }
  /// Of a direction, whose length stays.
  Vec3 direction(const Vec3& d) const { return x_ * d.x + y_ * d.y + z_ * d.z; }
  double scale() const { return scale_; }
  const Vec3& shift() const { return shift_; }
  std::array<Vec3, 3> axes() const { return {x_, y_, z_}; }

  Similarity inverse() const {
    Similarity back(std::array{Vec3{x_.x, y_.x, z_.x}, Vec3{x_.y, y_.y, z_.y}, Vec3{x_.z, y_.z, z_.z}},
                    1 / scale_, {});
    back.shift_ = -(back.direction(shift_) * back.scale_);
    return back;
  }
  /// First the right one, then the left one.
  friend Similarity operator*(const Similarity& a, const Similarity& b) {
    return Similarity(std::array{a.direction(b.x_), a.direction(b.y_), a.direction(b.z_)},
                      a.scale_ * b.scale_, a(b.shift_));
  }

 private:
  /// Exact where the angle is a multiple of 90 degrees.
  static std::array<double, 2> sineAndCosine(double degrees) {
    const double wrapped = std::remainder(degrees, 360);
    if (wrapped == 0) return {0, 1};
    if (std::abs(wrapped) == 180) return {0, -1};
    if (std::abs(wrapped) == 90) return {wrapped / 90, 0};
    const double radians = wrapped * std::numbers::pi / 180;
    return {std::sin(radians), std::cos(radians)};
  }

  Vec3 x_{1, 0, 0}, y_{0, 1, 0}, z_{0, 0, 1};
  double scale_ = 1;
  Vec3 shift_;
};

}  // namespace arete
