#include <array>
#include <cmath>

#include <Eigen/Core>

#include <pharos/guiding/toolkit/ray_integrals.h>
#include <pharos/guiding/toolkit/seen_gaussian.h>

namespace pharos {
namespace {

/// A direction or a mean, in world space or in whitened space. Whitening maps x to L^-1 x for the
/// covariance L L^T.
using Double3 = std::array<double, 3>;

double dot3(const Double3& a, const Double3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Double3 cross3(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Double3 offset(Point3 from, Point3 to) {
  return {double{to.x} - from.x, double{to.y} - from.y, double{to.z} - from.z};
}
Double3 to_double(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// The terms of the densities that follow from the direction and the mean in whitened space.
struct WhitenedRay {
  WhitenedRay(const SpatialGaussian& g, Point3 origin, Vec3 direction) {
    const Double3 v = whitened(g, to_double(direction));
    const Double3 m = whitened(g, offset(origin, g.mean));
    const double a = dot3(v, v);
    const Double3 moment = cross3(v, m);
    u = dot3(v, m) / std::sqrt(a);
    e = -dot3(moment, moment) / (2 * a);  // eq. 5
    far = std::exp(-0.5 * dot3(m, m));
    scale = 1 / (2 * EIGEN_PI * root_determinant(g) * a * std::sqrt(a));
  }
  double u, e, far, scale;
};

}  // namespace

double exact_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction) {
  const WhitenedRay ray(gaussian, origin, direction);
  return ray.scale * ray_integral(ray.u, ray.e, ray.far);
}

double flipped_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction) {
  if (gaussian.mean == origin) return exact_density(gaussian, origin, direction);
  if (dot3(offset(origin, gaussian.mean), to_double(direction)) < 0) return 0;
  const WhitenedRay ray(gaussian, origin, direction);
  return ray.scale * line_integral(ray.u, ray.e);
}

double projected_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction) {
  const Double3 aim = offset(origin, gaussian.mean);
  const double d = std::sqrt(dot3(aim, aim));
  const Double3 omega = to_double(direction);
  const double cosine = d > 0 ? dot3(aim, omega) / d : 0;
  if (!(cosine > 0)) return 0;
  // The point in which the direction meets the plane, relative to the mean.
  Double3 y;
  for (int i = 0; i < 3; ++i) y[i] = d / cosine * omega[i] - aim[i];
  // y^T S^-1 y for the projected covariance S. S^-1 is Sigma^-1 without the part along the line of
  // projection. The result is therefore the squared length of the part of the whitened y that is
  // perpendicular to the whitened line.
  const Double3 white = whitened(gaussian, y), line = whitened(gaussian, aim);
  const Double3 moment = cross3(white, line);
  const double squared = dot3(moment, moment) / dot3(line, line);
  // |S| = |Sigma| n^T Sigma^-1 n, with n = aim / d.
  const double determinant = root_determinant(gaussian) * std::sqrt(dot3(line, line)) / d;
  return std::exp(-0.5 * squared) * d * d / (2 * EIGEN_PI * determinant * cosine * cosine * cosine);
}

}  // namespace pharos
