// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// One small problem of a fit: by how much to raise a few vertices (the unknowns) so that every sample under
/// the triangles around them comes within its bound.
///
/// All is counted in units of a sample's bound: its residual (z_TIN - z_sample) / bound is a row, linear in
/// the unknowns, and must come to lie within [-accepted, accepted].
class FitPatch {
 public:
  /// residual = rest + sum of weight * unknown. Unused places have weight 0 and any unknown.
  struct Row {
    std::array<double, 3> weight = {};
    std::array<std::uint32_t, 3> unknown = {};
    double rest = 0;
  };

  /// Forgets all rows.
  void start(std::size_t unknowns);
  /// Precondition: every unknown named is below the number given to start().
  void add(const Row& row) { rows_.push_back(row); }
  std::size_t rowCount() const { return rows_.size(); }

  /// Looks for values of the unknowns, from 0 on, with all residuals within `accepted` (1 and what rounding
  /// takes). False when it finds none: there is none, nearly always; the method stops short of a proof. The
  /// values lie as near to a least-squares fit as it needs to. O(rounds * (rows + unknowns^3)), at most
  /// kRounds.
  bool solve(double accepted);
  /// What solve() came to. Precondition: it said true.
  std::span<const double> values() const { return values_; }

  static constexpr int kRounds = 20;

 private:
  void addSquare(const Row& row, std::vector<double>& matrix) const;
  /// Adds eps times the sum of all squares to the matrix and the gradient, and returns that sum.
  double addLeastSquares(double eps, double constant);
  /// Turns the gradient into the step: matrix * step = gradient. False when the matrix is not positive.
  bool step();

  std::size_t unknowns_ = 0;
  std::vector<Row> rows_;
  std::vector<double> values_;
  /// Of the sum of all squares: the matrix (its lower triangle, by rows), the slope at 0 and at the values.
  std::vector<double> squares_, linear_, slope_;
  std::vector<double> matrix_, gradient_;
};

}  // namespace arete
