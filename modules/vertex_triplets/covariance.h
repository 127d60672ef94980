#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/statistics/gaussian.h>

namespace pharos::vertex_triplets {

using statistics::Gaussian;
using statistics::Matrix;
using statistics::Vector;

/// How covariances of few points are regularized (Schuessler et al. 2022, section 6.2). Lengths are
/// in the unit of the points: edges of the cell.
struct Regularization {
  bool is_on = true;
  double deviation = 0.1;         ///< of a single point, r in eq. 40
  double least_deviation = 1e-4;  ///< its square is the lower bound of eigenvalues
  /// Standard deviation of a shift that all vertices of a single point have in common, along each
  /// axis. 0: the vertices are independent, as published.
  double shift = 0;
  double shift_of_last = 0;  ///< the same shift in the unit of the last vertex
};

/// Returns the covariance of a random shift that all vertices have in common, in addition to eq.
/// 40: s_i s_j times the identity in each 3 x 3 block, where s is the shift in the unit of the
/// vertex.
template <int D>
Matrix<D> covariance_of_shift(const Regularization& rule) {
  Matrix<D> covariance = Matrix<D>::Zero();
  const auto of = [&](int i) { return i + 3 == D ? rule.shift_of_last : rule.shift; };
  for (int i = 0; i < D; i += 3) {
    for (int j = 0; j < D; j += 3) {
      covariance.template block<3, 3>(i, j).diagonal().setConstant(of(i) * of(j));
    }
  }
  return covariance;
}

/// Returns the isotropic part of a covariance of 3D vertices: each 3 x 3 block is a third of its
/// trace times the identity (eq. 41). It is positive semidefinite if `sample` is.
template <int D>
Matrix<D> isotropic_blocks(const Matrix<D>& sample) {
  Matrix<D> blocks = Matrix<D>::Zero();
  for (int i = 0; i < D; i += 3) {
    for (int j = 0; j < D; j += 3) {
      const double third = sample.template block<3, 3>(i, j).trace() / 3;
      blocks.template block<3, 3>(i, j).diagonal().setConstant(third);
    }
  }
  return blocks;
}

/// Returns the share of the sample covariance in the regularized covariance of effectively `count`
/// points: lambda of eq. 44, corrected, with D in place of 9.
template <int D>
double share_of_sample(double count) {
  const double degrees = std::max(count - 1, 0.0);
  return degrees / (degrees + D);
}

/// Returns the regularized covariance of effectively `count` >= 1 points with the covariance
/// `sample` (eq. 39 to 44). The printed equations exchange both shares; here more points give
/// `sample` a larger share. The 9 of eq. 44 is the number of dimensions D here.
template <int D>
Matrix<D> regularized(const Matrix<D>& sample, double count, const Regularization& rule) {
  if (!rule.is_on) return sample;
  const double degrees = std::max(count - 1, 0.0);
  const double of_sample = share_of_sample<D>(count);
  const double of_blocks = std::min(degrees / 3, 1.0);
  Matrix<D> completed =
      of_sample * sample + (1 - of_sample) * of_blocks * isotropic_blocks<D>(sample);
  completed.diagonal().array() +=
      (1 - of_sample) * (1 - of_blocks) * rule.deviation * rule.deviation;
  if (rule.shift > 0) {
    completed += (1 - of_sample) * (1 - of_blocks) * covariance_of_shift<D>(rule);
  }
  return statistics::with_eigenvalues_above<D>(rule.least_deviation * rule.least_deviation,
                                               completed);
}

/// Returns the mean of log N(x) over points whose covariance about the Gaussian's mean is `sample`.
template <int D>
double mean_log_density(const Matrix<D>& sample, const Matrix<D>& covariance) {
  const Eigen::LLT<Matrix<D>> factor(covariance);
  const double log_determinant = 2 * Matrix<D>(factor.matrixL()).diagonal().array().log().sum();
  return -0.5 * (D * std::log(2 * EIGEN_PI) + log_determinant + factor.solve(sample).trace());
}

}  // namespace pharos::vertex_triplets
