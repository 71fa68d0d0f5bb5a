// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/base/vec.h"

namespace arete {

/// A sum of squared distances from planes, each with a weight [GarlandHeckbert1997].
class Quadric {
 public:
  Quadric() = default;
  /// The plane through a point with a normal of length 1.
  static Quadric ofPlane(const Vec3& point, const Vec3& normal, double weight);
  /// The weighted square of a linear function, by its gradient and its value at the origin.
  static Quadric ofLinear(const Vec3& gradient, double atOrigin, double weight);

  Quadric& operator+=(const Quadric& other);
  Quadric times(double factor) const;
  /// At least 0 but for rounding.
  double at(const Vec3& p) const;

  /// The least place, if the planes determine one well: a condition of at most 10^8, as the product of norms.
  std::optional<Vec3> least() const;
  /// The least place between two; nothing where all are equal.
  std::optional<Vec3> leastBetween(const Vec3& p, const Vec3& q) const;

 private:
  std::array<double, 6> a_{};  ///< xx, xy, xz, yy, yz, zz
  Vec3 b_{0, 0, 0};
  double c_ = 0;
};

/// The place for the vertex that some others become: the least of the quadric, else the least between two of
/// them, else the best of them and their middle. A place farther from their middle than twice their own
/// distance is not taken: a quadric of nearly parallel planes flings vertices.
Vec3 placeFor(const Quadric& quadric, std::span<const Vec3> vertices);

}  // namespace arete
