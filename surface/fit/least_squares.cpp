// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/least_squares.h"

#include "surface/algebra/conjugate_gradients.h"

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
      blocks_(elements.size()),
      right_(Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(vertices))) {
  for (auto& blocks : blocks_) blocks.fill(Symmetric3::Zero());
}

void MoveProblem::add(std::uint32_t element, const std::array<double, 3>& shares, const Symmetric3& metric,
                      const Vec3& residual) {
  const Eigen::Vector3d pull = unpacked(metric) * toEigen(residual);
  for (std::size_t b = 0; b < 6; ++b)
    blocks_[element][b] += shares[kPairs[b][0]] * shares[kPairs[b][1]] * metric;
  for (std::size_t c = 0; c < 3; ++c) right_.col(elements_[element][c]) += shares[c] * pull;
  stiffness_ += kStiffness * (metric[0] + metric[3] + metric[5]) / 3;
}

void MoveProblem::multiply(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& y) const {
  y = stiffness() * x;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t b = 0; b < 6; ++b) {
      const std::uint32_t i = elements_[e][kPairs[b][0]], j = elements_[e][kPairs[b][1]];
      const Eigen::Matrix3d block = unpacked(blocks_[e][b]);
      y.col(i) += block * x.col(j);
      if (kPairs[b][0] != kPairs[b][1]) y.col(j) += block * x.col(i);
    }
}

std::vector<Vec3> MoveProblem::solve(std::span<const std::uint8_t> isHeld) const {
  BlockMatrix matrix;
  matrix.diagonal.assign(isHeld.size(), stiffness() * identity3());
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t b = 0; b < 6; ++b)
      if (kPairs[b][0] == kPairs[b][1]) matrix.diagonal[elements_[e][kPairs[b][0]]] += blocks_[e][b];
  const auto hold = [&](Eigen::Matrix3Xd& x) {
    for (std::size_t v = 0; v < isHeld.size(); ++v)
      if (isHeld[v] != 0) x.col(static_cast<Eigen::Index>(v)).setZero();
  };
  matrix.multiply = [&](const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& y) {
    multiply(x, y);
    hold(y);
  };
  Eigen::Matrix3Xd right = right_;
  hold(right);
  return conjugateGradients(matrix, right, kAccuracy, kMostSteps);
}

}  // namespace arete
