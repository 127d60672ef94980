#include "mixture_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include <pharos/core/parallel.h>
#include <pharos/guiding/toolkit/ray_integrals.h>

namespace pharos::spatial_gaussians {
namespace {

using statistics::Matrix;
using statistics::Vector;

/// Returns the integral of N_i N_j / N, where N is `whole`; infinite if it does not exist.
double overlap(const Gaussian3& i, const Gaussian3& j, const Gaussian3& whole) {
  const Matrix<3> pi = i.covariance.inverse(), pj = j.covariance.inverse(),
                  p = whole.covariance.inverse();
  const Matrix<3> a = pi + pj - p;
  const Eigen::LLT<Matrix<3>> factor(a);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  // Positions are relative to the mean of `whole`, so its own terms vanish.
  const Vector<3> mi = i.mean - whole.mean, mj = j.mean - whole.mean;
  const Vector<3> h = pi * mi + pj * mj;
  const double s = mi.dot(pi * mi) + mj.dot(pj * mj) - h.dot(factor.solve(h));
  const double determinants =
      whole.covariance.determinant() /
      (i.covariance.determinant() * j.covariance.determinant() * a.determinant());
  return std::sqrt(determinants) * std::exp(-0.5 * s);
}

/// Eight samples as a structure of arrays. Missing samples are copies of the last one and count for
/// no step.
struct Samples8 {
  Samples8(std::span<const Sample> samples, std::size_t first, const Vector<3>& pivot) {
    for (std::size_t i = 0; i < 8; ++i) {
      const Sample& s = samples[std::min(first + i, samples.size() - 1)];
      const Vec3 direction = normalize(s.target - s.origin);
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis][i] = static_cast<float>(s.origin[axis] - pivot[axis]);
        omega[axis][i] = direction[axis];
      }
      steps[i] = first + i < samples.size() ? s.steps : 0.0f;
      pdf[i] = s.pdf;
      weight[i] = s.weight / s.steps;
    }
  }
  Float8 origin[3], omega[3], pdf, steps;
  Float8 weight;  ///< of each of the steps
};

/// A component in single precision, relative to the pivot.
struct Component {
  Component(double share, const Gaussian3& g) {
    const Matrix<3> l = Eigen::LLT<Matrix<3>>(g.covariance).matrixL();
    const Matrix<3> inverse =
        l.triangularView<Eigen::Lower>().solve(Matrix<3>(Matrix<3>::Identity()));
    for (int row = 0; row < 3; ++row) {
      mean[row] = static_cast<float>(g.mean[row]);
      for (int column = 0; column < 3; ++column) {
        // Scaled by l00, so that the determinants of small components are in the range of floats.
        whitening[row][column] = static_cast<float>(l(0, 0) * inverse(row, column));
      }
    }
    over_unit = static_cast<float>(1 / l(0, 0));
    scale = static_cast<float>(share * l(0, 0) * l(0, 0) / (2 * EIGEN_PI * l(1, 1) * l(2, 2)));
  }
  float mean[3], whitening[3][3];
  float over_unit;  ///< 1 / l00
  float scale;      ///< share / (2 pi |L / l00|)

  /// Returns the component's share times its exact directional density at the samples' origins.
  Float8 density(const Samples8& s) const {
    Float8 mu[3], v[3], m[3];
    for (int axis = 0; axis < 3; ++axis) mu[axis] = mean[axis] - s.origin[axis];
    for (int row = 0; row < 3; ++row) {
      const float* w = whitening[row];
      v[row] = w[0] * s.omega[0] + w[1] * s.omega[1] + w[2] * s.omega[2];
      m[row] = (w[0] * mu[0] + w[1] * mu[1] + w[2] * mu[2]) * over_unit;
    }
    const Float8 over_root = 1 / sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const Float8 along = v[0] * m[0] + v[1] * m[1] + v[2] * m[2];
    const Float8 x = v[1] * m[2] - v[2] * m[1], y = v[2] * m[0] - v[0] * m[2],
                 z = v[0] * m[1] - v[1] * m[0];
    const Float8 miss = (-0.5f * kLog2E) * (x * x + y * y + z * z);
    const Float8 over = over_root * over_root;
    const Rays8 rays{along * over_root, miss * over};
    const Float8 far = exp(-0.5f * (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]));
    return scale * (over * over_root) * rays.ray_integral(far);
  }
};

/// Constants of a test that are the same for all samples.
struct TestScale {
  float over_light;     ///< 1 / Phi
  float least_density;  ///< [1/sr]
};

/// Returns for each component k the sum of s p_k N_k (f / q - 1)^2 / p over the samples.
std::vector<double> sums_of_part(const std::vector<Component>& components, const Vector<3>& pivot,
                                 std::span<const Sample> samples, const TestScale& scale) {
  std::vector<double> sums(components.size());
  std::vector<Float8> densities(components.size());
  for (std::size_t first = 0; first < samples.size(); first += 8) {
    const Samples8 eight(samples, first, pivot);
    Float8 q = all8(scale.least_density);
    for (std::size_t k = 0; k < components.size(); ++k) {
      densities[k] = components[k].density(eight);
      q += densities[k];
    }
    const Float8 difference = eight.weight * eight.pdf * scale.over_light / q - 1;
    const Float8 factor = eight.steps * difference * difference / eight.pdf;
    for (std::size_t k = 0; k < components.size(); ++k) {
      const float sum_of_eight = sum(densities[k] * factor);
      if (std::isfinite(sum_of_eight)) sums[k] += sum_of_eight;  // else float overflow
    }
  }
  return sums;
}

}  // namespace

double merge_cost(double weight_i, const Gaussian3& i, double weight_j, const Gaussian3& j) {
  const double weight = weight_i + weight_j;
  const Moments3 joint =
      Moments3::of(weight_i, i.mean, i.covariance) + Moments3::of(weight_j, j.mean, j.covariance);
  const Gaussian3 whole{joint.mean(), joint.covariance()};
  const double sum = weight_i * weight_i * overlap(i, i, whole) +
                     2 * weight_i * weight_j * overlap(i, j, whole) +
                     weight_j * weight_j * overlap(j, j, whole);
  return sum / weight - weight;
}

std::vector<DirectionTest> test_directions(const Mixture& mixture, const Vector<3>& pivot,
                                           std::span<const Sample> samples, float least_density) {
  double light = 0, count = 0;
  for (const Sample& s : samples) {
    light += s.weight;
    count += s.steps;
  }
  std::vector<DirectionTest> tests(mixture.size(), {0, count});
  if (!(light > 0)) return tests;
  const auto over_light = static_cast<float>(count / light);
  std::vector<Component> components;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    components.emplace_back(mixture.weights[k], mixture.components[k]);
  }
  // Parts run concurrently and are added in order, so the result is the same for any number of
  // threads.
  constexpr std::size_t kPart = 4096;
  std::vector<std::vector<double>> sums((samples.size() + kPart - 1) / kPart);
  parallel_for(sums.size(), [&](std::size_t i) {
    const auto part = samples.subspan(i * kPart, std::min(kPart, samples.size() - i * kPart));
    sums[i] = sums_of_part(components, pivot, part, {over_light, least_density});
  });
  for (const std::vector<double>& part : sums) {
    for (std::size_t k = 0; k < tests.size(); ++k) tests[k].sum += part[k];
  }
  return tests;
}

}  // namespace pharos::spatial_gaussians
