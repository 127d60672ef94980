#pragma once

#include <cmath>

#include <pharos/core/simd.h>

/// The integrals along a ray that the directional densities of a Gaussian consist of (Lelyakin et
/// al. 2025, eq. 1 to 3), in whitened space. There the Gaussian is a unit one at distance m from
/// the origin, and a direction has the component u of the way to its center: its square is m^2 less
/// the squared distance at which the ray passes the center.
namespace pharos {

/// h(x) = int_0^inf r^2 e^(-r^2 / 2 - x r) dr = (1 + x^2) sqrt(pi / 2) erfcx(x / sqrt 2) - x for
/// x >= 0, relative error below 1e-9. Beyond 16 its asymptotic series, as small differences of
/// large numbers would be left.
inline double ray_moment(double x) {
  if (x > 16) {
    const double y = 1 / (x * x);
    double sum = 945945;
    for (const double c : {62370.0, 4725.0, 420.0, 45.0, 6.0, 1.0}) sum = c - y * sum;
    return 2 * y / x * sum;
  }
  constexpr double kRootHalfPi = 1.2533141373155003, kRootHalf = 0.70710678118654752;
  const double mills = kRootHalfPi * std::exp(0.5 * x * x) * std::erfc(kRootHalf * x);
  return (1 + x * x) * mills - x;
}

/// The same for eight, over sqrt(2 pi), relative error below 1.2e-6: a quotient of polynomials of
/// degree 3 and 6, whose largest error was made as small as could be.
inline Float8 ray_moment_over_root_2_pi(const Float8& x) {
  // In few steps that wait for each other.
  const Float8 x2 = x * x;
  const Float8 above = (0.499999466f + 0.275817440f * x) + x2 * (0.0736605683f + 0.0101847976f * x);
  const Float8 low = (1 + 2.14733682f * x) + x2 * (2.07466436f + 1.17105092f * x);
  const Float8 high = (0.422665511f + 0.0923137777f * x) + x2 * 0.0127647666f;
  return above / (low + x2 * x2 * high);
}

/// The integral over the whole line over sqrt(2 pi), for u and the logarithm `e` = -(m^2 - u^2) / 2
/// of what a ray gets that passes the center: (1 + u^2) e^e. (Eq. 3 with the exponent of eq. 5.)
inline double line_integral(double u, double e) {
  return (1 + u * u) * std::exp(e);
}

inline constexpr double kOverRoot2Pi = 0.39894228040143268;

/// The integral over the ray, r > 0, over sqrt(2 pi) (eq. 2); `far` = e^(-m^2 / 2). The line is the
/// ray and the one that looks back: whichever of both looks away from the center is h.
inline double ray_integral(double u, double e, double far) {
  const double away = far * ray_moment(std::abs(u)) * kOverRoot2Pi;
  return u < 0 ? away : line_integral(u, e) - away;
}

/// Eight rays in whitened space, in the form that guiders have them.
struct Rays8 {
  Float8 u;
  Float8 log2_hit;  ///< the logarithm to base 2 of e^e

  Float8 line_integral() const { return (1 + u * u) * exp2(log2_hit); }
  Float8 ray_integral(const Float8& far) const {
    const Float8 away = far * ray_moment_over_root_2_pi(absolute(u));
    return u < 0 ? away : line_integral() - away;
  }
};

}  // namespace pharos
