#pragma once

#include <cmath>

#include <Eigen/Dense>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/spatial_mixture.h>
#include <pharos/statistics/gaussian.h>

namespace pharos::vertex_triplets::testing {

using statistics::Gaussian;
using statistics::Matrix;
using statistics::Vector;

template <int D>
Vector<D> normal_vector(RandomStream& random) {
  Vector<D> x;
  for (double& v : x) v = warp::normal_from_unit(random.next_1d() + 0x1p-25);
  return x;
}

/// Returns a Gaussian with random axes and deviations between `least` and 1 times `size`.
template <int D>
Gaussian<D> any_gaussian(RandomStream& random, double size = 1, double least = 0.1) {
  Matrix<D> m;
  for (int i = 0; i < D; ++i) m.col(i) = normal_vector<D>(random);
  const Matrix<D> axes = Eigen::HouseholderQR<Matrix<D>>(m).householderQ();
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

inline SpatialGaussian spatial(const Gaussian<3>& g, float weight = 1) {
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

}  // namespace pharos::vertex_triplets::testing
