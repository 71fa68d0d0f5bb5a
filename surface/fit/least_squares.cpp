// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/least_squares.h"

#include <utility>

#include "engine/base/conjugate_gradients.h"

namespace arete {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
/// The weight of |d|^2 beside the mean diagonal: what no sample holds stays.
constexpr double kStiffness = 1e-4;
constexpr int kMostSteps = 400;
constexpr double kAccuracy = 1e-6;

}  // namespace

MoveProblem::MoveProblem(std::size_t vertices, std::span<const std::array<std::uint32_t, 3>> elements)
    : elements_(elements),
      blocks_(elements.size(), std::array<Symmetric3, 6>{}),
      right_(vertices, Vec3{0, 0, 0}) {}

void MoveProblem::add(std::uint32_t element, const std::array<double, 3>& shares, const Symmetric3& metric,
                      const Vec3& residual) {
  const Vec3 pull = times(metric, residual);
  for (std::size_t b = 0; b < 6; ++b) {
    const double weight = shares[kPairs[b][0]] * shares[kPairs[b][1]];
    for (std::size_t k = 0; k < 6; ++k) blocks_[element][b][k] += weight * metric[k];
  }
  for (std::size_t c = 0; c < 3; ++c) {
    Vec3& r = right_[elements_[element][c]];
    r = r + shares[c] * pull;
  }
  stiffness_ += kStiffness * (metric[0] + metric[3] + metric[5]) / 3;
}

void MoveProblem::multiply(std::span<const Vec3> x, std::span<Vec3> y) const {
  const double stiffness = stiffness_ / static_cast<double>(right_.size());
  for (std::size_t v = 0; v < x.size(); ++v) y[v] = stiffness * x[v];
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t b = 0; b < 6; ++b) {
      const std::uint32_t i = elements_[e][kPairs[b][0]], j = elements_[e][kPairs[b][1]];
      y[i] = y[i] + times(blocks_[e][b], x[j]);
      if (kPairs[b][0] != kPairs[b][1]) y[j] = y[j] + times(blocks_[e][b], x[i]);
    }
}

std::vector<Vec3> MoveProblem::solve(std::span<const std::uint8_t> isHeld) const {
  const std::size_t count = right_.size();
  const double stiffness = stiffness_ / static_cast<double>(count);
  std::vector<Symmetric3> diagonal(count, Symmetric3{stiffness, 0, 0, stiffness, 0, stiffness});
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t b = 0; b < 6; ++b)
      if (kPairs[b][0] == kPairs[b][1])
        for (std::size_t k = 0; k < 6; ++k) diagonal[elements_[e][kPairs[b][0]]][k] += blocks_[e][b][k];
  for (Symmetric3& d : diagonal) d = inverse(d);
  const auto hold = [&](std::span<Vec3> x) {
    for (std::size_t v = 0; v < count; ++v)
      if (isHeld[v] != 0) x[v] = {0, 0, 0};
  };
  std::vector<Vec3> right = right_;
  hold(right);
  return conjugateGradients(
      [&](std::span<const Vec3> x, std::span<Vec3> y) {
        multiply(x, y);
        hold(y);
      },
      diagonal, std::move(right), kAccuracy, kMostSteps);
}

}  // namespace arete
