#pragma once

#include <cmath>

#include <pharos/core/lanes.h>

/// The integrals along a ray that the directional densities of a Gaussian consist of (Lelyakin et
/// al. 2025, eq. 1 to 3), in whitened space. There the Gaussian is a unit one at distance m from
/// the origin, and a direction has the component u of the way to its centre: its square is m^2 less
/// the squared distance at which the ray passes the centre. Functions of one number (double) or of
/// eight side by side (Float8).
namespace pharos::gaussians {

namespace detail {
template <class T>
struct Element {
  using Type = T;
};
template <>
struct Element<Float8> {
  using Type = float;
};
}  // namespace detail
/// What T has side by side.
template <class T>
using ElementOf = typename detail::Element<T>::Type;

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

/// The same, relative error below 5e-6: (1 + c x)^-3 times a polynomial in 1 / (1 + c x), which
/// interpolates h at the Chebyshev points of [0, 1].
inline Float8 ray_moment(const Float8& x) {
  const Float8 t = 1 / (1 + 0.31f * x);
  Float8 p = all8(-0.442061384f);
  for (const float c : {1.79648843f, -2.43746367f, 0.928655027f, 0.00527203438f, 0.413707193f,
                        0.427802476f, 0.322563464f, 0.17876798f, 0.0595818855f}) {
    p = p * t + c;
  }
  return p * t * t * t;
}

/// The integral over the whole line over sqrt(2 pi), for u and the logarithm `e` = -(m^2 - u^2) / 2
/// of what a ray gets that passes the centre: (1 + u^2) e^e. (Eq. 3 with the exponent of eq. 5.)
template <class T>
T line_integral(const T& u, const T& e) {
  using pharos::exp;
  using std::exp;
  return (1 + u * u) * exp(e);
}

/// The integral over the ray, r > 0, over sqrt(2 pi) (eq. 2); `far` = e^(-m^2 / 2). The line is the
/// ray and the one that looks back: whichever of both looks away from the centre is h.
template <class T>
T ray_integral(const T& u, const T& e, const T& far) {
  constexpr auto kOverRoot2Pi = static_cast<ElementOf<T>>(0.39894228040143268);
  const T away = far * ray_moment(u < 0 ? -u : u) * kOverRoot2Pi;
  return u < 0 ? away : line_integral(u, e) - away;
}

}  // namespace pharos::gaussians
