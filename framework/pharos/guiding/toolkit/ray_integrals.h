#pragma once

#include <cmath>

#include <pharos/core/simd.h>

/// The integrals along a ray from which the directional densities of a Gaussian are composed
/// (Lelyakin et al. 2025, eq. 1 to 3), in whitened space. There, the Gaussian is a standard normal
/// distribution around a center at distance m from the origin of the ray. u is the component of the
/// vector to the center along the direction of the ray. Its square is m^2 minus the squared
/// distance at which the ray passes the center.
namespace pharos {

/// Returns h(x) = int_0^inf r^2 e^(-r^2 / 2 - x r) dr = (1 + x^2) sqrt(pi / 2) erfcx(x / sqrt 2) -
/// x for x >= 0, with a relative error below 1e-9. Above x = 16 the function uses the asymptotic
/// series, because the closed form is then a small difference of large numbers.
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

/// Returns h(x) / sqrt(2 pi) for eight values, with a relative error below 1.2e-6. It evaluates a
/// quotient of polynomials of degree 3 and 6 whose largest error was minimized.
inline Float8 ray_moment_over_root_2_pi(const Float8& x) {
  // The order of operations keeps chains of dependent operations short.
  const Float8 x2 = x * x;
  const Float8 above = (0.499999466f + 0.275817440f * x) + x2 * (0.0736605683f + 0.0101847976f * x);
  const Float8 low = (1 + 2.14733682f * x) + x2 * (2.07466436f + 1.17105092f * x);
  const Float8 high = (0.422665511f + 0.0923137777f * x) + x2 * 0.0127647666f;
  return above / (low + x2 * x2 * high);
}

/// Returns the integral over the whole line, divided by sqrt(2 pi): (1 + u^2) e^e (eq. 3 with the
/// exponent of eq. 5). `e` = -(m^2 - u^2) / 2 is the logarithm of the largest value of the Gaussian
/// on the line, relative to its value at the center.
inline double line_integral(double u, double e) {
  return (1 + u * u) * std::exp(e);
}

inline constexpr double kOverRoot2Pi = 0.39894228040143268;

/// Returns the integral over the ray, r > 0, divided by sqrt(2 pi) (eq. 2). `far` is e^(-m^2 / 2).
/// The line consists of the ray and of the opposite ray. The integral over the one that points away
/// from the center is computed with ray_moment().
inline double ray_integral(double u, double e, double far) {
  const double away = far * ray_moment(std::abs(u)) * kOverRoot2Pi;
  return u < 0 ? away : line_integral(u, e) - away;
}

/// Eight rays in whitened space, in the form in which guiders store them.
struct Rays8 {
  Float8 u;
  Float8 log2_hit;  ///< logarithm to base 2 of e^e; see line_integral()

  Float8 line_integral() const { return (1 + u * u) * exp2(log2_hit); }
  Float8 ray_integral(const Float8& far) const {
    const Float8 away = far * ray_moment_over_root_2_pi(absolute(u));
    return u < 0 ? away : line_integral() - away;
  }
};

}  // namespace pharos
