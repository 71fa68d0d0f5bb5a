// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least squares function of a chart, of the least gradient where the chart is flat, is one that the chart
// is if it leaves no more than rounding.
#include "surface/fit/affine_charts.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "surface/algebra/symmetric3.h"
#include "surface/topology/disjoint_sets.h"

namespace arete {
namespace {

/// Directions in which a chart is thinner than this share of its largest extent are not used.
constexpr double kFlat = 1e-6;

}  // namespace

AffineCharts::AffineCharts(std::span<const std::array<std::uint32_t, 3>> elements,
                           const std::vector<std::uint32_t>& vertexOf, const std::vector<Vec3>& positions,
                           const std::vector<double>& numbers, std::size_t components, double tolerance) {
  DisjointSets sets(vertexOf.size());
  std::vector<std::uint8_t> isUsed(vertexOf.size(), 0);
  for (const auto& [a, b, c] : elements) {
    sets.unite(a, b);
    sets.unite(a, c);
    isUsed[a] = isUsed[b] = isUsed[c] = 1;
  }
  std::uint32_t count = 0;
  const auto numbered = sets.numbered(count);
  chartOf.assign(numbered.begin(), numbered.end());
  function.resize(count);

  struct Sums {
    double count = 0;
    Vec3 middle{0, 0, 0};
    std::vector<double> mean;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    std::vector<Eigen::Vector3d> right;
  };
  std::vector<Sums> all(count);
  const auto eachUsed = [&](const auto& visit) {
    for (std::size_t e = 0; e < vertexOf.size(); ++e)
      if (isUsed[e] != 0)
        visit(all[chartOf[e]], chartOf[e], positions[vertexOf[e]], &numbers[e * components]);
  };
  for (Sums& s : all) {
    s.mean.assign(components, 0);
    s.right.assign(components, Eigen::Vector3d::Zero());
  }
  eachUsed([&](Sums& s, std::uint32_t, const Vec3& p, const double* n) {
    ++s.count;
    s.middle = s.middle + p;
    for (std::size_t c = 0; c < components; ++c) s.mean[c] += n[c];
  });
  for (Sums& s : all) {
    if (s.count == 0) continue;
    s.middle = s.middle / s.count;
    for (double& m : s.mean) m /= s.count;
  }
  eachUsed([&](Sums& s, std::uint32_t, const Vec3& p, const double* n) {
    const Eigen::Vector3d d = toEigen(p - s.middle);
    s.spread += d * d.transpose();
    for (std::size_t c = 0; c < components; ++c) s.right[c] += d * (n[c] - s.mean[c]);
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    const Sums& s = all[i];
    if (s.count == 0) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(s.spread);
    AffineFunction f{s.middle, s.mean, {}};
    for (std::size_t c = 0; c < components; ++c) {
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        if (solver.eigenvalues()[axis] > kFlat * kFlat * solver.eigenvalues()[2])
          gradient += solver.eigenvectors().col(axis) *
                      (solver.eigenvectors().col(axis).dot(s.right[c]) / solver.eigenvalues()[axis]);
      f.gradient.push_back({gradient[0], gradient[1], gradient[2]});
    }
    function[i] = std::move(f);
  }
  eachUsed([&](Sums&, std::uint32_t chart, const Vec3& p, const double* n) {
    for (std::size_t c = 0; c < components && function[chart]; ++c)
      if (!(std::abs((*function[chart])(c, p) - n[c]) <= tolerance)) function[chart].reset();
  });
}

}  // namespace arete
