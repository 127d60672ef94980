// rayleigh: scattering of unpolarized light by particles much smaller than a wavelength. Forward
// and backward scattering are equal, and sideways scattering is half as strong. With the angle t
// between the directions of flight before and after scattering:
//
//     p(t) = 3 / (16 pi) (1 + cos^2 t)  [1/sr]
//
// The color of such scattering, for example in the sky, is set by the medium's coefficients.
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
  // The distribution function of c = cos t is (c^3 + 3 c + 4) / 8. Cardano's formula inverts it.
  // The larger of the two cube roots is computed; the other is minus its inverse.
  const float half = 2 * (2 * u.x - 1);
  const float root = std::cbrt(std::abs(half) + std::sqrt(square(half) + 1));
  const float cosine = std::copysign(root - 1 / root, half);
  return Frame::from_normal(-wo).to_world(warp::about_z(1 - cosine, u.y));
}

}  // namespace pharos
