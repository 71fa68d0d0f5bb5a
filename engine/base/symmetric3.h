// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "engine/base/vec.h"

namespace arete {

/// A symmetric matrix of 3 x 3: xx, xy, xz, yy, yz, zz.
using Symmetric3 = std::array<double, 6>;

constexpr Symmetric3 kUnit3 = {1, 0, 0, 1, 0, 1};

constexpr Vec3 times(const Symmetric3& m, const Vec3& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[1] * v.x + m[3] * v.y + m[4] * v.z,
          m[2] * v.x + m[4] * v.y + m[5] * v.z};
}

/// n n' + across (I - n n'): squares of lengths along n, and a part of those across it.
/// Precondition: n has length 1.
constexpr Symmetric3 metricAlong(const Vec3& n, double across) {
  const double a = 1 - across;
  return {a * n.x * n.x + across, a * n.x * n.y, a * n.x * n.z,
          a * n.y * n.y + across, a * n.y * n.z, a * n.z * n.z + across};
}

/// The inverse of a matrix that is positive definite.
constexpr Symmetric3 inverse(const Symmetric3& m) {
  const double xx = m[3] * m[5] - m[4] * m[4], xy = m[2] * m[4] - m[1] * m[5], xz = m[1] * m[4] - m[2] * m[3];
  const double determinant = m[0] * xx + m[1] * xy + m[2] * xz;
  return {xx / determinant,
          xy / determinant,
          xz / determinant,
          (m[0] * m[5] - m[2] * m[2]) / determinant,
          (m[1] * m[2] - m[0] * m[4]) / determinant,
          (m[0] * m[3] - m[1] * m[1]) / determinant};
}

}  // namespace arete
