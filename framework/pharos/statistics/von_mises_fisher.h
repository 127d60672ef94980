#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/frame.h>
#include <pharos/core/warp.h>

/// The von Mises-Fisher distribution of directions, kappa / (2 pi (1 - e^(-2 kappa)))
/// e^(kappa (cos theta - 1)) [1/sr]. This form is numerically stable for any concentration
/// kappa >= 0.
namespace pharos::von_mises_fisher {

/// Lower bound of concentrations where quotients of their differences must stay numerically stable.
inline constexpr float kLeastKappa = 1e-3f;

inline constexpr double kTwoPi = 6.28318530717958648;

/// Returns the density at the mean direction [1/sr]; for small kappa by its series, with an error
/// of second order in kappa.
inline double mode_density(double kappa) {
  if (kappa < 1e-5) return (1 + kappa) / (2 * kTwoPi);
  return kappa / (-kTwoPi * std::expm1(-2 * kappa));
}

/// Returns ln(kappa / (4 pi sinh kappa)), the logarithm of the density's factor before
/// e^(kappa cos theta).
inline double log_norm(double kappa) {
  return std::log(mode_density(kappa)) - kappa;
}

/// Returns the mean of cos theta, coth kappa - 1 / kappa, in [0, 1).
inline double mean_cosine(double kappa) {
  if (kappa < 1e-3) return kappa / 3;
  const double e = std::exp(-2 * kappa);
  return (1 + e) / (1 - e) - 1 / kappa;
}

/// Returns the concentration for a mean cosine r in [0, 1), the inverse of mean_cosine(). Newton's
/// method starts at the approximation (3 r - r^3) / (1 - r^2) of Banerjee et al. 2005.
inline double concentration(double r) {
  if (r < 1e-3) return 3 * r;
  double kappa = r * (3 - r * r) / ((1 - r) * (1 + r));
  for (int i = 0; i < 4; ++i) {
    const double a = mean_cosine(kappa);
    kappa -= (a - r) / (1 - a * a - 2 * a / kappa);
  }
  return kappa;
}

/// Returns the value of 1 - cos theta for which the fraction `left` in (0, 1] of all directions is
/// farther from the mean: -ln(left + (1 - left) e^(-2 kappa)) / kappa.
inline float versine(float kappa, float left) {
  constexpr float kFlat = 1e-4f, kWide = 0.5f, kNarrow = 9;
  if (kappa < kFlat) return 2 * (1 - left);
  // For wide lobes the formula itself would lose digits. For narrow lobes the second term is below
  // the rounding error.
  const float v = kappa < kWide     ? -std::log1p((1 - left) * std::expm1(-2 * kappa))
                  : kappa < kNarrow ? -std::log(left + (1 - left) * std::exp(-2 * kappa))
                                    : -std::log(left);
  return std::min(v / kappa, 2.0f);
}

/// Samples a direction around `mean` from u in [0, 1)^2, with a map from the square to the disk.
inline Vec3 sample(Vec3 mean, float kappa, Vec2 u) {
  const warp::ConcentricPoint p = warp::concentric_from_square(u);
  // r^2 is uniform. Computing 1 - r^2 as a product keeps the digits of small numbers.
  const float left = std::max((1 - p.radius) * (1 + p.radius), 0x1p-25f);
  const float v = versine(kappa, left);
  const float sine = std::copysign(std::sqrt(v * (2 - v)), p.radius);
  return Frame::from_normal(mean).to_world({sine * p.direction.x, sine * p.direction.y, 1 - v});
}

}  // namespace pharos::von_mises_fisher
