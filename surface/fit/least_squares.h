// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"
#include "surface/algebra/symmetric3.h"

namespace arete {

/// The least squares problem of vertices that move by d: the sum of (r - d(s))' M (r - d(s)) over samples s,
/// where d(s) is the mean of the moves of a triangle's corners with the sample's shares, and of a small
/// multiple of |d|^2. Kept by triangle, never as a matrix.
class MoveProblem {
 public:
  MoveProblem(std::size_t vertices, std::span<const std::array<std::uint32_t, 3>> elements);

  /// Adds a sample of an element.
  /// @param shares   of the element's corners
  /// @param metric   M
  /// @param residual r
  void add(std::uint32_t element, const std::array<double, 3>& shares, const Symmetric3& metric,
           const Vec3& residual);

  /// The moves, by conjugate gradients with the diagonal blocks as preconditioner.
  /// @param isHeld  by vertex: its move is 0
  std::vector<Vec3> solve(std::span<const std::uint8_t> isHeld) const;

 private:
  void multiply(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& y) const;
  double stiffness() const { return stiffness_ / static_cast<double>(right_.cols()); }

  std::span<const std::array<std::uint32_t, 3>> elements_;
  std::vector<std::array<Symmetric3, 6>> blocks_;  ///< by element: of corners 00, 01, 02, 11, 12, 22
  Eigen::Matrix3Xd right_;                         ///< a column for each vertex
  double stiffness_ = 0;                           ///< of |d|^2, summed over the vertices
};

}  // namespace arete
