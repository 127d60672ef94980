#include <Eigen/Eigenvalues>

#include <pharos/statistics/gaussian.h>

namespace pharos::statistics {
namespace {

/// A symmetric matrix of at most 9 rows, on the stack.
using AnyMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 9, 9>;
using AnyVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 9, 1>;

}  // namespace

template <int D>
Matrix<D> with_eigenvalues_above(double floor, const Matrix<D>& symmetric) {
  // Most matrices need no change. A Cholesky factor proves that, and costs less than eigenvalues.
  // The margin covers the rounding errors of both.
  const double margin = 1e-12 * symmetric.trace();
  const Matrix<D> excess = symmetric - (floor + margin) * Matrix<D>::Identity();
  if (excess.llt().info() == Eigen::Success) return symmetric;
  const Eigen::SelfAdjointEigenSolver<AnyMatrix> eigen(symmetric);
  if (eigen.eigenvalues()[0] >= floor) return symmetric;
  const AnyVector raised = eigen.eigenvalues().cwiseMax(floor);
  const AnyMatrix result =
      eigen.eigenvectors() * raised.asDiagonal() * eigen.eigenvectors().transpose();
  return 0.5 * (result + result.transpose());
}

template <int D>
Matrix<D> eigenvectors(const Matrix<D>& symmetric) {
  return Eigen::SelfAdjointEigenSolver<AnyMatrix>(symmetric).eigenvectors();
}

// Eigenvalues take long to compile, so they are compiled here once.
template Matrix<2> with_eigenvalues_above(double, const Matrix<2>&);
template Matrix<3> with_eigenvalues_above(double, const Matrix<3>&);
template Matrix<6> with_eigenvalues_above(double, const Matrix<6>&);
template Matrix<9> with_eigenvalues_above(double, const Matrix<9>&);
template Matrix<3> eigenvectors(const Matrix<3>&);
template Matrix<6> eigenvectors(const Matrix<6>&);
template Matrix<9> eigenvectors(const Matrix<9>&);

Vector<3> principal_axis(const Matrix<3>& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix<3>>(symmetric).eigenvectors().col(2);
}

}  // namespace pharos::statistics
