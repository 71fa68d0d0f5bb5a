// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eigen's conjugate gradients on the matrix that block Jacobi scales: with D = C C' the diagonal blocks,
// Eigen solves (inv(C) A inv(C')) y = inv(C) b without a preconditioner of its own, and x = inv(C') y. The
// iterates are those of preconditioned conjugate gradients, and the residual that Eigen compares with the
// accuracy is the preconditioned one, whose size does not depend on how well a vertex is held.
#include "surface/algebra/conjugate_gradients.h"

#include <Eigen/Cholesky>
#include <Eigen/IterativeLinearSolvers>

namespace arete {
class ScaledMatrix;
}

namespace Eigen::internal {
template <>
struct traits<arete::ScaledMatrix> : traits<Eigen::SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace arete {

/// The scaled matrix, in the form in which Eigen's solvers take a matrix that is not stored.
class ScaledMatrix : public Eigen::EigenBase<ScaledMatrix> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  explicit ScaledMatrix(const BlockMatrix& a) : a_(a) {
    inverses_.reserve(a.diagonal.size());
    for (const Symmetric3& block : a.diagonal)
      inverses_.push_back(
          Eigen::LLT<Eigen::Matrix3d>(unpacked(block)).matrixL().solve(Eigen::Matrix3d::Identity().eval()));
  }

  Eigen::Index rows() const { return 3 * static_cast<Eigen::Index>(inverses_.size()); }
  Eigen::Index cols() const { return rows(); }
  template <class Right>
  Eigen::Product<ScaledMatrix, Right, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Right>& x) const {
    return {*this, x.derived()};
  }

  /// inv(C) x.
  Eigen::VectorXd scaled(const Eigen::Matrix3Xd& x) const {
    Eigen::VectorXd y(x.size());
    for (Eigen::Index v = 0; v < x.cols(); ++v) y.segment<3>(3 * v) = inverseOf(v) * x.col(v);
    return y;
  }
  /// inv(C') y.
  Eigen::Matrix3Xd unscaled(const Eigen::VectorXd& y) const {
    Eigen::Matrix3Xd x(3, y.size() / 3);
    for (Eigen::Index v = 0; v < x.cols(); ++v) x.col(v) = inverseOf(v).transpose() * y.segment<3>(3 * v);
    return x;
  }
  Eigen::VectorXd times(const Eigen::VectorXd& y) const {
    const Eigen::Matrix3Xd x = unscaled(y);
    Eigen::Matrix3Xd product(3, x.cols());
    a_.multiply(x, product);
    return scaled(product);
  }

 private:
  const Eigen::Matrix3d& inverseOf(Eigen::Index v) const { return inverses_[static_cast<std::size_t>(v)]; }

  const BlockMatrix& a_;
  std::vector<Eigen::Matrix3d> inverses_;  // by unknown: inv(C)
};

}  // namespace arete

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<arete::ScaledMatrix, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<arete::ScaledMatrix, Right,
                                generic_product_impl<arete::ScaledMatrix, Right>> {
  using Scalar = double;
  template <class Result>
  static void scaleAndAddTo(Result& result, const arete::ScaledMatrix& a, const Right& x, double factor) {
    result.noalias() += factor * a.times(x);
  }
};
}  // namespace Eigen::internal

namespace arete {

std::vector<Vec3> conjugateGradients(const BlockMatrix& a, const Eigen::Matrix3Xd& b, double accuracy,
                                     int mostSteps) {
  std::vector<Vec3> result(static_cast<std::size_t>(b.cols()), Vec3{0, 0, 0});
  if (b.isZero(0)) return result;
  const ScaledMatrix matrix(a);
  Eigen::ConjugateGradient<ScaledMatrix, Eigen::Lower | Eigen::Upper, Eigen::IdentityPreconditioner> solver;
  solver.setTolerance(accuracy);
  solver.setMaxIterations(mostSteps);
  solver.compute(matrix);
  const Eigen::Matrix3Xd x = matrix.unscaled(solver.solve(matrix.scaled(b)));
  if (!x.allFinite()) return result;
  for (std::size_t v = 0; v < result.size(); ++v) {
    const auto column = x.col(static_cast<Eigen::Index>(v));
    result[v] = {column[0], column[1], column[2]};
  }
  return result;
}

}  // namespace arete
