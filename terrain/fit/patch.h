// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// The small feasibility problem of a patch: by how much to raise a few vertices (the unknowns) so that every
/// sample under the triangles around them is within its bound. Solved by a penalty method with Newton steps,
/// after [Mangasarian2004].
///
/// Everything is in units of a sample's bound: the residual (z_TIN - z_sample) / bound of a sample is a row,
/// linear in the unknowns, and must lie within [-accepted, accepted].
class FitPatch {
 public:
  /// residual = rest + sum of weight * unknown. Unused terms have weight 0 and any valid unknown.
  struct Row {
    std::array<double, 3> weight = {};
    std::array<std::uint32_t, 3> unknown = {};
    double rest = 0;
  };

  /// Begins a problem: removes all rows.
  void start(std::size_t unknowns);
  /// Precondition: the row's unknowns are below the number given to start().
  void add(const Row& row) { rows_.push_back(row); }
  std::size_t rowCount() const { return rows_.size(); }

  /// Searches values of the unknowns with all residuals within `accepted`. The values found are close to the
  /// least-squares fit. O(rounds * (rows + unknowns^3)), at most kRounds rounds.
  /// @param accepted  1 and an allowance for rounding
  /// @return false where none were found; nearly always there are none then, but that is not proved
  bool solve(double accepted);
  /// The values found. Precondition: solve() has returned true.
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
