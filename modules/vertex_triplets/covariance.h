#pragma once

#include <algorithm>

#include <pharos/statistics/gaussian.h>

namespace pharos::vertex_triplets {

using statistics::Gaussian;
using statistics::Matrix;
using statistics::Vector;

/// How covariances of few points are completed (Schuessler et al. 2022, section 6.2). Lengths are
/// in the unit of the points: edges of the cell.
struct Regularization {
  bool is_on = true;
  double deviation = 0.1;         ///< of a single point, r in eq. 40
  double least_deviation = 1e-4;  ///< eigenvalues are raised to its square
};

/// The part of a covariance of 3D vertices that is alike along all axes: of each 3 x 3 block a
/// third of its trace times the identity (eq. 41). Positive semidefinite if `sample` is.
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

/// The covariance of points whose own is `sample`, of which there are effectively `count` >= 1
/// (eq. 39 to 44). As printed both shares would be the wrong way round: here more points mean more
/// of `sample`, and 9 is the number of dimensions.
template <int D>
Matrix<D> regularized(const Matrix<D>& sample, double count, const Regularization& rule) {
  if (!rule.is_on) return sample;
  const double degrees = std::max(count - 1, 0.0);
  const double of_sample = degrees / (degrees + D);
  const double of_blocks = std::min(degrees / 3, 1.0);
  Matrix<D> completed =
      of_sample * sample + (1 - of_sample) * of_blocks * isotropic_blocks<D>(sample);
  completed.diagonal().array() +=
      (1 - of_sample) * (1 - of_blocks) * rule.deviation * rule.deviation;
  return statistics::with_eigenvalues_above<D>(rule.least_deviation * rule.least_deviation,
                                               completed);
}

}  // namespace pharos::vertex_triplets
