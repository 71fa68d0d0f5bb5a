// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// The least squares problem of numbers at the corners of triangles: the sum of (r - d(s))^2 over samples s,
/// where d(s) is the mean of the changes d of a triangle's corners with the sample's shares, and of a small
/// multiple of d^2. Kept by triangle, never as a matrix.
class ScalarProblem {
 public:
  /// @param triangles corners are unknowns, below `unknowns`; they must outlive it
  ScalarProblem(std::size_t unknowns, std::span<const std::array<std::uint32_t, 3>> triangles);

  /// Adds a sample of a triangle.
  void add(std::uint32_t triangle, const std::array<double, 3>& shares);

  /// The changes, by conjugate gradients with the diagonal as preconditioner. Deterministic.
  /// O(steps * triangles).
  /// @param right   by unknown: the sum of shares times residuals
  /// @param isHeld  by unknown: its change is 0
  std::vector<double> solve(std::span<const double> right, std::span<const std::uint8_t> isHeld) const;

 private:
  void multiply(const std::vector<double>& x, std::vector<double>& y) const;

  std::size_t unknowns_;
  std::span<const std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::array<double, 6>> blocks_;  ///< by triangle: of corners 00, 01, 02, 11, 12, 22
  double samples_ = 0;
};

}  // namespace arete
