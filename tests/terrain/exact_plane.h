// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "engine/base/vec.h"

namespace arete::test {

/// Errors of planes in whole numbers: every double is a whole number of the least double. An oracle that
/// shares no code with the program and rounds nothing.
class ExactPlane {
 public:
  using Whole = boost::multiprecision::cpp_int;

  /// @param corner  counter-clockwise in the plan
  explicit ExactPlane(const std::array<Vec3, 3>& corner)
      : a_(of(corner[0])), b_(of(corner[1])), c_(of(corner[2])), area_(doubledArea(a_, b_, c_)) {}

  /// Whether the triangle covers the sample, edges and corners included.
  bool covers(const Vec3& sample) const {
    const Point p = of(sample);
    return doubledArea(a_, b_, p) >= 0 && doubledArea(b_, c_, p) >= 0 && doubledArea(c_, a_, p) >= 0;
  }
  /// Whether |z of the plane - z of the sample| is at most the bound.
  bool isWithin(const Vec3& sample, double bound) const {
    const Point p = of(sample);
    const Whole difference = doubledArea(p, b_, c_) * (a_.z - p.z) + doubledArea(a_, p, c_) * (b_.z - p.z) +
                             doubledArea(a_, b_, p) * (c_.z - p.z);
    return abs(difference) <= whole(bound) * area_;
  }

 private:
  struct Point {
    Whole x, y, z;
  };
  static Whole whole(double x) {
    if (x == 0) return 0;
    int exponent = 0;
    const double significand = std::frexp(x, &exponent);
    Whole result = static_cast<long long>(std::ldexp(significand, 53));
    const int shift = exponent - 53 + 1074;
    return shift >= 0 ? Whole(result << shift) : Whole(result >> -shift);
  }
  static Point of(const Vec3& p) { return {whole(p.x), whole(p.y), whole(p.z)}; }
  static Whole doubledArea(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

  Point a_, b_, c_;
  Whole area_;
};

}  // namespace arete::test
