#include "next_group.h"

#include "truncated_normal.h"

namespace pharos::vertex_triplets {

void NextGroup::clear() {
  share = Float8{};
  mean = {Float8{}, Float8{}, Float8{}};
  const SpatialGaussian ball;
  for (int i = 0; i < 6; ++i) cholesky[i] = all8(ball.cholesky[i]);
}

void NextGroup::set(unsigned lane, const SpatialGaussian& gaussian) {
  share[lane] = gaussian.weight;
  mean.x[lane] = gaussian.mean.x;
  mean.y[lane] = gaussian.mean.y;
  mean.z[lane] = gaussian.mean.z;
  for (int i = 0; i < 6; ++i) cholesky[i][lane] = gaussian.cholesky[i];
}

Float8 truncated_densities(const NextGroup& group, Point3 point) {
  const Float8* l = group.cholesky;
  // In double precision, because the terms of thin Gaussians nearly cancel.
  const Double8 one = all_doubles8(1);
  const Double8 over0 = one / widened(l[0]), over1 = one / widened(l[2]),
                over2 = one / widened(l[5]);
  const Lanes3<Float8> d = all8(point) - group.mean;
  const Double8 a = widened(d.x) * over0;
  const Double8 b = (widened(d.y) - widened(l[1]) * a) * over1;
  const Double8 c = (widened(d.z) - widened(l[3]) * a - widened(l[4]) * b) * over2;
  const Float8 z0 = rounded(a), z1 = rounded(b), z2 = rounded(c);
  const Mask8 inside = within_truncation(z0) & within_truncation(z1) & within_truncation(z2);
  const Float8 exponential = exp2((-0.5f * kLog2E) * (z0 * z0 + z1 * z1 + z2 * z2));
  constexpr double kPeak = double{kTruncatedPeak} * kTruncatedPeak * kTruncatedPeak;
  const Float8 scale = rounded(kPeak * (over0 * over1 * over2));
  return inside ? exponential * scale : Float8{};
}

}  // namespace pharos::vertex_triplets
