// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether there are values within the bounds is a linear program. It is solved as a sequence of smooth
// problems [Mangasarian2004]: minimise
//
//      sum of max(0, |residual| - T)^2  +  eps * sum of residual^2,        eps = 1, 1/5, 1/25, ...
//
// with T slightly below the bound, one Newton step for each eps. The sequence begins at the least-squares fit
// and approaches the nearest feasible values; it stops as soon as all residuals are within the bounds. So the
// residuals stay as small as possible on the whole, which later removals nearby need. (Minimising the largest
// residual instead leaves less slack: 26 instead of 31 % fewer triangles.)
//
// The same sums detect infeasibility. For feasible values the function is at most eps * rows * T^2; if its
// minimum for this eps is larger, there are none. One step does not reach the minimum, so the search is given
// up only if the function exceeds that value by 30 %.
#include "terrain/fit/patch.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr double kTarget = 0.995;         // T
constexpr double kFall = 0.2;             // of eps from round to round
constexpr double kGiveUp = 1.3;           // times the value that proves infeasibility at the minimum
constexpr double kRegularisation = 1e-6;  // of the diagonal of the squares

double residual(const FitPatch::Row& row, const std::vector<double>& values) {
  return row.rest + row.weight[0] * values[row.unknown[0]] + row.weight[1] * values[row.unknown[1]] +
         row.weight[2] * values[row.unknown[2]];
}

}  // namespace

void FitPatch::start(std::size_t unknowns) {
  unknowns_ = unknowns;
  rows_.clear();
}

/// Adds the square of a row to the lower triangle of a matrix.
void FitPatch::addSquare(const Row& row, std::vector<double>& matrix) const {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b <= a; ++b) {
      const std::size_t i = std::max(row.unknown[a], row.unknown[b]),
                        j = std::min(row.unknown[a], row.unknown[b]);
      matrix[i * unknowns_ + j] += row.weight[a] * row.weight[b];
    }
}

/// Gaussian elimination of a symmetric matrix from its last row up: the unknowns of the outermost ring come
/// first; they have few neighbours, so most factors are zero. Runs along rows, so that it vectorises.
bool FitPatch::step() {
  const std::size_t n = unknowns_;
  double* g = gradient_.data();
  for (std::size_t k = n; k-- > 0;) {
    const double* row = matrix_.data() + k * n;
    if (!(row[k] > 0)) return false;
    for (std::size_t i = 0; i < k; ++i) {
      if (row[i] == 0) continue;
      const double factor = row[i] / row[k];
      double* other = matrix_.data() + i * n;
      for (std::size_t j = 0; j <= i; ++j) other[j] -= factor * row[j];
      g[i] -= factor * g[k];
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double* row = matrix_.data() + k * n;
    for (std::size_t i = 0; i < k; ++i) g[k] -= row[i] * g[i];
    g[k] /= row[k];
  }
  return true;
}

bool FitPatch::solve(double accepted) {
  const std::size_t n = unknowns_;
  values_.assign(n, 0);
  squares_.assign(n * n, 0);
  linear_.assign(n, 0);
  double constant = 0;
  for (const Row& row : rows_) {
    addSquare(row, squares_);
    for (int a = 0; a < 3; ++a) linear_[row.unknown[a]] += row.weight[a] * row.rest;
    constant += row.rest * row.rest;
  }
  // An unknown without a row keeps the value 0.
  for (std::size_t i = 0; i < n; ++i)
    if (!(squares_[i * n + i] > 0)) squares_[i * n + i] = 1;

  double eps = 1;
  for (int round = 0; round <= kRounds; ++round, eps *= kFall) {
    double worst = 0, beyond = 0;
    matrix_.assign(n * n, 0);
    gradient_.assign(n, 0);
    for (const Row& row : rows_) {
      const double r = residual(row, values_), size = std::abs(r);
      worst = std::max(worst, size);
      if (size <= kTarget || round == 0) continue;  // the first round is plain least squares
      const double violation = r > 0 ? r - kTarget : r + kTarget;
      beyond += violation * violation;
      addSquare(row, matrix_);
      for (int a = 0; a < 3; ++a) gradient_[row.unknown[a]] -= row.weight[a] * violation;
    }
    if (round > 0 && worst <= accepted) return true;
    if (!(worst < 1e100)) return false;
    const double all = addLeastSquares(eps, constant);
    const double last = eps / kFall;
    if (round > 1 && beyond + last * all > kGiveUp * last * kTarget * kTarget * double(rows_.size()))
      return false;
    if (!step()) return false;
    for (std::size_t i = 0; i < n; ++i) values_[i] += gradient_[i];
  }
  return false;
}

double FitPatch::addLeastSquares(double eps, double constant) {
  const std::size_t n = unknowns_;
  slope_ = linear_;  // half the slope of the sum of squares
  for (std::size_t i = 0; i < n; ++i) {
    const double* row = squares_.data() + i * n;
    double* into = matrix_.data() + i * n;
    for (std::size_t j = 0; j < i; ++j) {
      into[j] += eps * row[j];
      slope_[i] += row[j] * values_[j];
      slope_[j] += row[j] * values_[i];
    }
    into[i] += (eps + kRegularisation) * row[i];
    slope_[i] += row[i] * values_[i];
  }
  double all = constant;
  for (std::size_t i = 0; i < n; ++i) {
    all += values_[i] * (slope_[i] + linear_[i]);
    gradient_[i] -= eps * slope_[i];
  }
  return all;
}

}  // namespace arete
