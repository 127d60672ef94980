#pragma once

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/spatial_mixture.h>

namespace pharos::spatial_gaussians::testing {

inline Eigen::Vector3d normal_vector(RandomStream& random) {
  Eigen::Vector3d x;
  for (double& v : x) v = warp::normal_from_unit(random.next_1d() + 0x1p-25);
  return x;
}

/// Returns a Gaussian with these standard deviations along random axes.
inline SpatialGaussian oriented_gaussian(Point3 mean, Vec3 deviations, RandomStream& random) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) m.col(i) = normal_vector(random);
  const Eigen::Matrix3d axes = Eigen::HouseholderQR<Eigen::Matrix3d>(m).householderQ();
  const Eigen::Vector3d s(deviations.x, deviations.y, deviations.z);
  const Eigen::Matrix3d covariance = axes * s.cwiseAbs2().asDiagonal() * axes.transpose();
  const Eigen::Matrix3d l = Eigen::LLT<Eigen::Matrix3d>(covariance).matrixL();
  const auto f = [](double v) { return static_cast<float>(v); };
  return {1, mean, {f(l(0, 0)), f(l(1, 0)), f(l(1, 1)), f(l(2, 0)), f(l(2, 1)), f(l(2, 2))}};
}

/// Returns a random unit vector, uniform over the sphere.
inline Vec3 any_direction(RandomStream& random) {
  return warp::sphere_from_square(random.next_2d());
}

/// Returns a random number between two limits, uniform on a logarithmic scale.
inline double log_uniform(double low, double high, RandomStream& random) {
  return low * std::pow(high / low, random.next_1d());
}

/// Returns a random point of the Gaussian, relative to `origin`.
inline Vec3 point_of(const SpatialGaussian& g, Point3 origin, RandomStream& random) {
  const Eigen::Vector3d z = normal_vector(random);
  const Vec3 p{static_cast<float>(z[0]), static_cast<float>(z[1]), static_cast<float>(z[2])};
  return spread(g, p) + (g.mean - origin);
}

}  // namespace pharos::spatial_gaussians::testing
