#pragma once

#include <array>

#include <pharos/core/archive.h>
#include <pharos/core/vec.h>

namespace pharos {

/// One component of a mixture of 3D Gaussians over positions of the next vertex.
struct SpatialGaussian {
  float weight = 0;  ///< >= 0; the weights of a mixture sum to 1
  Point3 mean;
  /// Lower triangle of the Cholesky factor L of the covariance, Sigma = L L^T [scene units]:
  /// l00, l10, l11, l20, l21, l22.
  float cholesky[6] = {1, 0, 1, 0, 0, 1};
  void archive(Archive& archive) { archive(weight, mean, cholesky); }
};

/// Returns L^-1 x. This maps a point of the Gaussian, centered at the origin, to a point of the
/// standard normal distribution.
inline std::array<double, 3> whitened(const SpatialGaussian& g, const std::array<double, 3>& x) {
  const float* l = g.cholesky;
  const double a = x[0] / l[0];
  const double b = (x[1] - l[1] * a) / l[2];
  return {a, b, (x[2] - l[3] * a - l[4] * b) / l[5]};
}
/// Returns L z. This maps a point of the standard normal distribution to a point of the Gaussian,
/// centered at the origin.
inline Vec3 spread(const SpatialGaussian& g, Vec3 z) {
  const float* l = g.cholesky;
  return {l[0] * z.x, l[1] * z.x + l[2] * z.y, l[3] * z.x + l[4] * z.y + l[5] * z.z};
}
/// Returns |L|, the square root of the determinant of the covariance [scene units^3].
inline double root_determinant(const SpatialGaussian& g) {
  return double{g.cholesky[0]} * g.cholesky[2] * g.cholesky[5];
}

}  // namespace pharos
