#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/frame.h>
#include <pharos/core/warp.h>

/// The von Mises-Fisher distribution of directions, kappa / (2 pi (1 - e^(-2 kappa)))
/// e^(kappa (cos theta - 1)) [1/sr]: the form that is sound for any concentration kappa >= 0.
namespace pharos::parallax_aware_mixtures {

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

/// 1 - cos theta where `left` in (0, 1] of all directions are farther from the mean:
/// -ln(left + (1 - left) e^(-2 kappa)) / kappa.
inline float versine(float kappa, float left) {
  constexpr float kFlat = 1e-4f, kWide = 0.5f, kNarrow = 9;
  if (kappa < kFlat) return 2 * (1 - left);
  // Wide lobes would lose digits, for narrow ones the second term is below rounding.
  const float v = kappa < kWide     ? -std::log1p((1 - left) * std::expm1(-2 * kappa))
                  : kappa < kNarrow ? -std::log(left + (1 - left) * std::exp(-2 * kappa))
                                    : -std::log(left);
  return std::min(v / kappa, 2.0f);
}

/// A direction around `mean` from u in [0, 1)^2, by way of the disk.
inline Vec3 sample(Vec3 mean, float kappa, Vec2 u) {
  const warp::ConcentricPoint p = warp::concentric_from_square(u);
  // The disk's r^2 is uniform; 1 - r^2 by its factors keeps the digits of small numbers.
  const float left = std::max((1 - p.radius) * (1 + p.radius), 0x1p-25f);
  const float v = versine(kappa, left);
  const float sine = std::copysign(std::sqrt(v * (2 - v)), p.radius);
  return Frame::from_normal(mean).to_world({sine * p.direction.x, sine * p.direction.y, 1 - v});
}

}  // namespace pharos::parallax_aware_mixtures
