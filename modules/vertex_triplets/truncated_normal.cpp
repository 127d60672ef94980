#include "truncated_normal.h"

#include <pharos/core/frame.h>

namespace pharos::vertex_triplets {

Projection::Projection(const SpatialGaussian& g, Point3 origin) {
  const Vec3 offset = g.mean - origin;
  distance_ = length(offset);
  if (!(distance_ > 0)) return;
  towards_ = offset / distance_;
  const Frame frame = Frame::from_normal(towards_);
  across_[0] = frame.s;
  across_[1] = frame.t;
  // The projected covariance is S = (L^T Q^T)^T (L^T Q^T). The rows of Q are across the line of
  // sight.
  const auto through = [&](Vec3 q) {
    const float* l = g.cholesky;
    return Vec3{l[0] * q.x + l[1] * q.y + l[3] * q.z, l[2] * q.y + l[4] * q.z, l[5] * q.z};
  };
  const Vec3 a = through(frame.s), b = through(frame.t);
  cholesky_[0] = length(a);
  cholesky_[1] = dot(a, b) / cholesky_[0];
  // The length of the part of b that is perpendicular to a, without a difference of squares.
  cholesky_[2] = length(cross(a, b)) / cholesky_[0];
}

Vec3 Projection::sample(Vec2 u) const {
  const float z0 = truncated_normal(u.x), z1 = truncated_normal(u.y);
  const float s = cholesky_[0] * z0, t = cholesky_[1] * z0 + cholesky_[2] * z1;
  return normalize(distance_ * towards_ + s * across_[0] + t * across_[1]);
}

float Projection::density(Vec3 direction) const {
  // For narrow Gaussians far away, single precision would leave few digits of small angles.
  const auto along = [&](Vec3 axis) {
    return double{axis.x} * direction.x + double{axis.y} * direction.y +
           double{axis.z} * direction.z;
  };
  const double cosine = along(towards_);
  if (!(cosine > 0)) return 0;
  const double scale = distance_ / cosine;
  const double z0 = scale * along(across_[0]) / cholesky_[0];
  const double z1 = (scale * along(across_[1]) - cholesky_[1] * z0) / cholesky_[2];
  const float across = truncated_normal_density(static_cast<float>(z0)) *
                       truncated_normal_density(static_cast<float>(z1));
  return static_cast<float>(across * scale * scale / (cosine * cholesky_[0] * cholesky_[2]));
}

}  // namespace pharos::vertex_triplets
