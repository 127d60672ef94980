// henyey_greenstein: scattering mostly forwards (g > 0) or backwards (g < 0), by Henyey and
// Greenstein 1941 ("Diffuse radiation in the galaxy", eq. 2). With the angle t between the
// directions of flight before and after scattering:
//
//     p(t) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos t)^(3/2))  [1/sr]
//
// The mean cosine is g. The value 0 is isotropic; haze has about 0.98.
//
//     phase: { type: henyey_greenstein, g: 0.8 }

#include "henyey_greenstein.h"

#include <cmath>

#include <pharos/core/warp.h>

namespace pharos {

void HenyeyGreensteinPhase::Settings::describe(Schema<Settings>& s) {
  s.field("g", &Settings::g, "Mean cosine of the scattering angle; 0 is isotropic")
      .at_least(-0.9999f)
      .at_most(0.9999f);
  s.example("{ g: 0.6 }");
  s.example("{ g: -0.4 }");
  s.example("{ g: 0.98 }");
}

float HenyeyGreensteinPhase::evaluate(Vec3 wo, Vec3 wi) const {
  // Computes 1 + g^2 - 2 |g| cos from the chord of the angle to the lobe's axis. The square of the
  // chord is 2 - 2 cos, and it keeps the digits of small angles.
  const float g = std::abs(g_);
  const Vec3 chord = g_ > 0 ? wi + wo : wi - wo;
  const float base = square(1 - g) + g * length_squared(chord);
  return (1 - square(g)) / (4 * kPi * base * std::sqrt(base));
}

Vec3 HenyeyGreensteinPhase::sample(Vec3 wo, Vec2 u) const {
  // The inverse of the distribution function of cos is (1 + g^2 - s^2) / (2 g), with
  // s = (1 - g^2) / (1 + g - 2 g u). The form below gives 1 - cos without differences of close
  // numbers, and it also holds for g = 0.
  const float g = std::abs(g_);
  const float divisor = 1 + g - 2 * g * u.x;
  const float one_minus_cos = (1 - g) * u.x / divisor * ((1 - square(g)) / divisor + 1 - g);
  return Frame::from_normal(g_ > 0 ? -wo : wo).to_world(warp::about_z(one_minus_cos, u.y));
}

}  // namespace pharos
