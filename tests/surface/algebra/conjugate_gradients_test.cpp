// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/algebra/conjugate_gradients.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace arete {
namespace {

/// A stored symmetric positive definite matrix as one that is not stored.
BlockMatrix notStored(const Eigen::MatrixXd& a) {
  BlockMatrix matrix;
  for (Eigen::Index v = 0; v < a.rows() / 3; ++v)
    matrix.diagonal.push_back(packed(a.block<3, 3>(3 * v, 3 * v)));
  matrix.multiply = [a](const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& y) {
    y = (a * x.reshaped()).reshaped(3, x.cols());
  };
  return matrix;
}

Eigen::MatrixXd randomMatrix(Eigen::Index size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd m = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
  return m * m.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

double largestDifference(const std::vector<Vec3>& x, const Eigen::VectorXd& expected) {
  double largest = 0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(3 * v);
    largest = std::max({largest, std::abs(x[v].x - expected[row]), std::abs(x[v].y - expected[row + 1]),
                        std::abs(x[v].z - expected[row + 2])});
  }
  return largest;
}

TEST(ConjugateGradients, GiveWhatADirectSolverGives) {
  std::mt19937 random(20261127);
  for (const Eigen::Index unknowns : {1, 2, 5, 20, 40}) {
    SCOPED_TRACE(unknowns);
    const Eigen::MatrixXd a = randomMatrix(3 * unknowns, random);
    const Eigen::Matrix3Xd b = Eigen::Matrix3Xd::NullaryExpr(3, unknowns, [&] { return random() * 1e-9; });
    const Eigen::VectorXd expected = a.fullPivLu().solve(b.reshaped().eval());
    EXPECT_LT(largestDifference(conjugateGradients(notStored(a), b, 1e-13, 2000), expected),
              1e-6 * (1 + expected.cwiseAbs().maxCoeff()));
  }
}

TEST(ConjugateGradients, TakeOneStepWhereTheDiagonalBlocksAreAll) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(6, 6);
  a.block<3, 3>(0, 0) << 4, 1, 0, 1, 3, 1, 0, 1, 2;
  a.block<3, 3>(3, 3) << 1e6, 0, 0, 0, 2e6, 5, 0, 5, 1;
  const Eigen::Matrix3Xd b = (Eigen::Matrix3Xd(3, 2) << 1, 2, 3, 4, 5, 6).finished();
  EXPECT_LT(largestDifference(conjugateGradients(notStored(a), b, 1e-12, 1),
                              a.fullPivLu().solve(b.reshaped().eval())),
            1e-12);
}

TEST(ConjugateGradients, GiveZerosWithoutARightSideOrWithASingularDiagonal) {
  const std::vector<Vec3> zeros(2, Vec3{0, 0, 0});
  EXPECT_EQ(
      conjugateGradients(notStored(Eigen::MatrixXd::Identity(6, 6)), Eigen::Matrix3Xd::Zero(3, 2), 1e-6, 9),
      zeros);
  EXPECT_EQ(conjugateGradients(notStored(Eigen::MatrixXd::Zero(6, 6)), Eigen::Matrix3Xd::Ones(3, 2), 1e-6, 9),
            zeros);
}

TEST(Symmetric3, MetricsSplitALengthIntoAlongAndAcross) {
  const Vec3 n = unit(Vec3{1, -2, 3});
  const Eigen::Vector3d along = toEigen(n), across = toEigen(unit(Vec3{2, 1, 0}));
  const auto lengthOf = [](const Symmetric3& m, const Eigen::Vector3d& v) { return v.dot(unpacked(m) * v); };
  EXPECT_NEAR(lengthOf(metricAlong(n, 0.25), along), 1, 1e-15);
  EXPECT_NEAR(lengthOf(metricAlong(n, 0.25), across), 0.25, 1e-15);
  EXPECT_NEAR(lengthOf(metricAcross(n, 0.25), along), 0.25, 1e-15);
  EXPECT_NEAR(lengthOf(metricAcross(n, 0.25), across), 1, 1e-15);
}

}  // namespace
}  // namespace arete
