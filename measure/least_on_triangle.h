// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "measure/near_numbers.h"

namespace arete {

/// The distance of two tuples of like size. In [0, infinity]; infinite where a number is not finite and the
/// tuples are not equal.
double numbersApart(NumbersNorm norm, std::span<const double> a, std::span<const double> b);

/// Of a triangle whose numbers are linear, its point within a distance of another whose numbers are nearest
/// to wanted ones.
class LeastOnTriangle {
 public:
  struct Found {
    double apart = 0;
    Vec3 place;
  };

  explicit LeastOnTriangle(NumbersNorm norm, std::size_t components)
      : norm_(norm), components_(components), scratch_(components) {}

  /// The numbers at a point of the triangle, linear means of its corners'.
  /// @param corners  corner by corner
  std::span<const double> at(const SpaceTriangle& t, std::span<const double> corners, const Vec3& p);

  /// No point of the triangle within the distance has numbers nearer than this. O(components)
  double atLeast(const SpaceTriangle& t, std::span<const double> corners, std::span<const double> wanted,
                 const Vec3& x, double within) const;

  /// Precondition: the triangle has a point within the distance; nearest is its nearest to x. O(steps^2)
  /// @param steps  golden sections: each leaves .618 of the last
  Found find(const SpaceTriangle& t, std::span<const double> corners, std::span<const double> wanted,
             const Vec3& x, double within, const Vec3& nearest, int steps);

 private:
  NumbersNorm norm_;
  std::size_t components_;
  std::vector<double> scratch_;
};

}  // namespace arete
