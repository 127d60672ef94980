#include "test_gaussians.h"

#include <cmath>

#include <pharos/core/warp.h>

namespace pharos::vertex_triplets::testing {

template <int D>
Vector<D> normal_vector(RandomStream& random) {
  Vector<D> x;
  for (double& v : x) v = warp::normal_from_unit(random.next_1d() + 0x1p-25);
  return x;
}

namespace {

/// Returns a random orthogonal matrix (Gram-Schmidt).
template <int D>
Matrix<D> random_axes(RandomStream& random) {
  Matrix<D> axes;
  for (int i = 0; i < D; ++i) {
    Vector<D> axis = normal_vector<D>(random);
    for (int k = 0; k < i; ++k) axis -= axes.col(k).dot(axis) * axes.col(k);
    axes.col(i) = axis.normalized();
  }
  return axes;
}

}  // namespace

template <int D>
Gaussian<D> any_gaussian(RandomStream& random, double size, double least) {
  const Matrix<D> axes = random_axes<D>(random);
  Vector<D> variances;
  for (double& v : variances) v = std::pow(size * std::pow(least, random.next_1d()), 2);
  return {size * normal_vector<D>(random), axes * variances.asDiagonal() * axes.transpose()};
}

template <int D>
Vector<D> point_of(const Gaussian<D>& g, RandomStream& random) {
  const Matrix<D> l = Eigen::LLT<Matrix<D>>(g.covariance).matrixL();
  return g.mean + l * normal_vector<D>(random);
}

template <int D>
double density(const Gaussian<D>& g, const Vector<D>& x) {
  const Eigen::LLT<Matrix<D>> factor(g.covariance);
  const Matrix<D> l = factor.matrixL();
  const double squared = (x - g.mean).dot(factor.solve(x - g.mean));
  return std::exp(-0.5 * squared) / (std::pow(2 * EIGEN_PI, 0.5 * D) * l.diagonal().prod());
}

template Vector<3> normal_vector(RandomStream&);
template Vector<6> normal_vector(RandomStream&);
template Vector<9> normal_vector(RandomStream&);
template Gaussian<3> any_gaussian(RandomStream&, double, double);
template Gaussian<6> any_gaussian(RandomStream&, double, double);
template Gaussian<9> any_gaussian(RandomStream&, double, double);
template Vector<3> point_of(const Gaussian<3>&, RandomStream&);
template Vector<6> point_of(const Gaussian<6>&, RandomStream&);
template Vector<9> point_of(const Gaussian<9>&, RandomStream&);
template double density(const Gaussian<3>&, const Vector<3>&);
template double density(const Gaussian<6>&, const Vector<6>&);
template double density(const Gaussian<9>&, const Vector<9>&);

SpatialGaussian spatial(const Gaussian<3>& g, float weight) {
  const Matrix<3> l = Eigen::LLT<Matrix<3>>(g.covariance).matrixL();
  SpatialGaussian s;
  s.weight = weight;
  for (int row = 0, i = 0; row < 3; ++row) {
    s.mean[row] = static_cast<float>(g.mean[row]);
    for (int column = 0; column <= row; ++column)
      s.cholesky[i++] = static_cast<float>(l(row, column));
  }
  return s;
}

bool is_positive_definite(const Matrix<9>& matrix) {
  return Eigen::LLT<Matrix<9>>(matrix).info() == Eigen::Success;
}

}  // namespace pharos::vertex_triplets::testing
