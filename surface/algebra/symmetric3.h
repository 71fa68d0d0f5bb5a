// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "engine/base/vec.h"

namespace arete {

/// A symmetric matrix of 3 x 3, packed: xx, xy, xz, yy, yz, zz. Sums and multiples of packed matrices are
/// those of the matrices.
template <class Scalar>
using Symmetric3Of = Eigen::Matrix<Scalar, 6, 1>;
using Symmetric3 = Symmetric3Of<double>;

inline Eigen::Vector3d toEigen(const Vec3& v) {
  return {v.x, v.y, v.z};
}

/// The matrix itself.
template <class Scalar>
Eigen::Matrix3d unpacked(const Symmetric3Of<Scalar>& m) {
  Eigen::Matrix3d whole;
  whole << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  return whole;
}

inline Symmetric3 packed(const Eigen::Matrix3d& m) {
  return (Symmetric3() << m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)).finished();
}

inline Symmetric3 identity3() {
  return packed(Eigen::Matrix3d::Identity());
}

/// n n' + across (I - n n'): squares of lengths along n, and a fraction of the squares across it.
/// Precondition: n has length 1.
inline Symmetric3 metricAlong(const Vec3& n, double across) {
  const Eigen::Vector3d along = toEigen(n);
  return packed((1 - across) * along * along.transpose() + across * Eigen::Matrix3d::Identity());
}

/// (I - t t') + across t t': squares of lengths across t, and a fraction of the squares along it.
/// Precondition: t has length 1.
inline Symmetric3 metricAcross(const Vec3& t, double along) {
  const Eigen::Vector3d direction = toEigen(t);
  return packed(Eigen::Matrix3d::Identity() - (1 - along) * direction * direction.transpose());
}

}  // namespace arete
