// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/scalar_problem.h"

#include <cmath>

namespace arete {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> kScalarPairs = {
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
/// The weight of d^2 beside the mean diagonal: what no sample holds stays.
constexpr double kScalarStiffness = 1e-3;
constexpr int kMostScalarSteps = 400;
constexpr double kScalarAccuracy = 1e-9;

}  // namespace

ScalarProblem::ScalarProblem(std::size_t unknowns, std::span<const std::array<std::uint32_t, 3>> triangles)
    : unknowns_(unknowns), triangles_(triangles), blocks_(triangles.size()) {
  for (auto& block : blocks_) block.fill(0);
}

void ScalarProblem::add(std::uint32_t triangle, const std::array<double, 3>& shares) {
  for (std::size_t b = 0; b < 6; ++b)
    blocks_[triangle][b] += shares[kScalarPairs[b][0]] * shares[kScalarPairs[b][1]];
  ++samples_;
}

void ScalarProblem::multiply(const std::vector<double>& x, std::vector<double>& y) const {
  const double stiffness = kScalarStiffness * samples_ / static_cast<double>(unknowns_);
  for (std::size_t i = 0; i < unknowns_; ++i) y[i] = stiffness * x[i];
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t b = 0; b < 6; ++b) {
      const std::uint32_t i = triangles_[t][kScalarPairs[b][0]], j = triangles_[t][kScalarPairs[b][1]];
      y[i] += blocks_[t][b] * x[j];
      if (kScalarPairs[b][0] != kScalarPairs[b][1]) y[j] += blocks_[t][b] * x[i];
    }
}

std::vector<double> ScalarProblem::solve(std::span<const double> right,
                                         std::span<const std::uint8_t> isHeld) const {
  const std::size_t n = unknowns_;
  std::vector<double> x(n, 0), r(right.begin(), right.end()), z(n), p(n), q(n);
  if (!(samples_ > 0)) return x;
  std::vector<double> diagonal(n, kScalarStiffness * samples_ / static_cast<double>(n));
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t b = 0; b < 6; ++b)
      if (kScalarPairs[b][0] == kScalarPairs[b][1])
        diagonal[triangles_[t][kScalarPairs[b][0]]] += blocks_[t][b];
  // @return r' inv(diagonal) r of the unknowns that are free
  const auto precondition = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (isHeld[i] != 0) r[i] = 0;
      z[i] = r[i] / diagonal[i];
      sum += r[i] * z[i];
    }
    return sum;
  };
  double rz = precondition();
  const double enough = kScalarAccuracy * kScalarAccuracy * rz;
  p = z;
  for (int step = 0; step < kMostScalarSteps && rz > enough; ++step) {
    multiply(p, q);
    double pq = 0;
    for (std::size_t i = 0; i < n; ++i) pq += isHeld[i] != 0 ? 0 : p[i] * q[i];
    if (!(pq > 0)) break;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += rz / pq * p[i];
      r[i] -= rz / pq * q[i];
    }
    const double next = precondition();
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
  return x;
}

}  // namespace arete
