#include "projections.h"

#include "truncated_normal.h"

namespace pharos::vertex_triplets {

Projections::Projections(const NextGroup& group, Point3 origin) {
  const Lanes3<Float8> offset = group.mean - all8(origin);
  constexpr float kLeast = 1e-30f;  // the means that are nearer are not possible
  distance_ = sqrt(dot(offset, offset));
  towards_ = (1 / larger(distance_, all8(kLeast))) * offset;
  across_ = perpendicular(towards_);
  // The projected covariance is S = (L^T Q^T)^T (L^T Q^T). The rows of Q are across the line of
  // sight.
  const auto through = [&](const Lanes3<Float8>& q) -> Lanes3<Float8> {
    const Float8* l = group.cholesky;
    return {l[0] * q.x + l[1] * q.y + l[3] * q.z, l[2] * q.y + l[4] * q.z, l[5] * q.z};
  };
  const Lanes3<Float8> a = through(across_[0]), b = through(across_[1]);
  l00_ = sqrt(dot(a, a));
  over_l00_ = 1 / l00_;
  l10_ = dot(a, b) * over_l00_;
  // The length of the part of b that is perpendicular to a, without a difference of squares.
  const Lanes3<Float8> area = cross(a, b);
  l11_ = sqrt(dot(area, area)) * over_l00_;
  over_l11_ = 1 / l11_;
  weight_ = square(kTruncatedPeak) * (distance_ * over_l00_) * (distance_ * over_l11_);
}

Vec3 Projections::sample(unsigned lane, Vec2 u) const {
  const float z0 = truncated_normal(u.x), z1 = truncated_normal(u.y);
  const float s = l00_[lane] * z0, t = l10_[lane] * z0 + l11_[lane] * z1;
  return normalize(distance_[lane] * lane_of(towards_, lane) + s * lane_of(across_[0], lane) +
                   t * lane_of(across_[1], lane));
}

Float8 Projections::densities(Vec3 direction) const {
  // Cosines are cubed, so their relative errors near the horizon matter.
  const Float8 cosine = rounded(widened(towards_.x) * all_doubles8(direction.x) +
                                widened(towards_.y) * all_doubles8(direction.y) +
                                widened(towards_.z) * all_doubles8(direction.z));
  constexpr float kLeast = 1e-10f;  // its cube is still in the range of floats
  const Float8 over = 1 / larger(cosine, all8(kLeast));
  // Axes across the line of sight are applied to differences from it. These are exact if they are
  // small, so directions to narrow Gaussians far away keep their digits.
  const Lanes3<Float8> off = all8(direction) - towards_;
  const Float8 scale = distance_ * over;
  const Float8 z0 = scale * dot(across_[0], off) * over_l00_;
  const Float8 z1 = (scale * dot(across_[1], off) - l10_ * z0) * over_l11_;
  const Mask8 inside = (cosine > kLeast) & within_truncation(z0) & within_truncation(z1);
  const Float8 value = weight_ * exp2((-0.5f * kLog2E) * (z0 * z0 + z1 * z1));
  return inside ? value * over * over * over : Float8{};
}

}  // namespace pharos::vertex_triplets
