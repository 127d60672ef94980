// rayleigh: what particles much smaller than a wavelength do with unpolarized light, as much
// forwards as backwards, half as much aside. With the angle t between the directions of flight
// before and after:
//
//     p(t) = 3 / (16 pi) (1 + cos^2 t)  [1/sr]
//
// The color of such scattering, as of the sky, is for the medium's coefficients to say.
//
//     phase: rayleigh

#include "rayleigh.h"

#include <cmath>

#include <pharos/core/warp.h>

namespace pharos {

float RayleighPhase::evaluate(Vec3 wo, Vec3 wi) const {
  return 3 / (16 * kPi) * (1 + square(dot(wo, wi)));
}

Vec3 RayleighPhase::sample(Vec3 wo, Vec2 u) const {
  // The distribution of c = cos t is (c^3 + 3 c + 4) / 8: Cardano's formula for its inverse. Of the
  // two cube roots the larger is taken, the other is minus its inverse.
  const float half = 2 * (2 * u.x - 1);
  const float root = std::cbrt(std::abs(half) + std::sqrt(square(half) + 1));
  const float cosine = std::copysign(root - 1 / root, half);
  return Frame::from_normal(-wo).to_world(warp::about_z(1 - cosine, u.y));
}

}  // namespace pharos
