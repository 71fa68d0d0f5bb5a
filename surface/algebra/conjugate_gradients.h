// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "engine/base/vec.h"
#include "surface/algebra/symmetric3.h"

namespace arete {

/// A symmetric positive definite matrix A of 3 x 3 blocks that is never stored: what it does to a vector, and
/// its diagonal blocks. Vectors have one column for each unknown of three numbers.
struct BlockMatrix {
  std::function<void(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& y)> multiply;  ///< stores A x in y
  std::vector<Symmetric3> diagonal;
};

/// Solves A x = b by conjugate gradients, preconditioned by the diagonal blocks (block Jacobi). Ends where
/// the preconditioned residual is `accuracy` of its first value, or after `mostSteps`. Deterministic.
/// O(steps * (unknowns + multiply)). Zeros where b is zero, or the diagonal is singular.
std::vector<Vec3> conjugateGradients(const BlockMatrix& a, const Eigen::Matrix3Xd& b, double accuracy,
                                     int mostSteps);

}  // namespace arete
