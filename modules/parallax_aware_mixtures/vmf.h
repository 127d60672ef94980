#pragma once

#include <cmath>

#include <pharos/core/frame.h>
#include <pharos/core/vec.h>

/// The von Mises-Fisher distribution of directions, kappa / (2 pi (1 - e^(-2 kappa)))
/// e^(kappa (cos theta - 1)) [1/sr]: the form that is sound for any concentration kappa >= 0.
namespace pharos::vmf {

inline constexpr double kTwoPi = 6.28318530717958648;

/// The density at the mean direction [1/sr]. (To second order in kappa where it is small.)
inline double mode_density(double kappa) {
  if (kappa < 1e-5) return (1 + kappa) / (2 * kTwoPi);
  return kappa / (-kTwoPi * std::expm1(-2 * kappa));
}

/// ln(kappa / (4 pi sinh kappa)): of what stands before e^(kappa cos theta).
inline double log_norm(double kappa) {
  return std::log(mode_density(kappa)) - kappa;
}

/// The mean of cos theta, coth kappa - 1 / kappa, in [0, 1).
inline double mean_cosine(double kappa) {
  if (kappa < 1e-3) return kappa / 3;
  const double e = std::exp(-2 * kappa);
  return (1 + e) / (1 - e) - 1 / kappa;
}

/// The concentration for a mean cosine r in [0, 1): its inverse, by Newton's method from the
/// approximation (3 r - r^3) / (1 - r^2) of Banerjee et al. 2005.
inline double concentration(double r) {
  if (r < 1e-3) return 3 * r;
  double kappa = r * (3 - r * r) / ((1 - r) * (1 + r));
  for (int i = 0; i < 4; ++i) {
    const double a = mean_cosine(kappa);
    kappa -= (a - r) / (1 - a * a - 2 * a / kappa);
  }
  return kappa;
}

/// 1 - cos theta for u in [0, 1).
inline float versine(float kappa, float u) {
  constexpr float kFlat = 1e-4f;
  if (kappa < kFlat) return 2 * u;
  const float v = -std::log1p(u * std::expm1(-2 * kappa)) / kappa;
  return v < 2 ? v : 2;
}

/// A direction around `mean` from u in [0, 1)^2.
inline Vec3 sample(Vec3 mean, float kappa, Vec2 u) {
  const float v = versine(kappa, u.x);
  const float sine = std::sqrt(v * (2 - v)), phi = 2 * kPi * u.y;
  return Frame::from_normal(mean).to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - v});
}

}  // namespace pharos::vmf
