#include <cmath>

#include <boost/math/special_functions/erf.hpp>

#include <pharos/core/warp.h>

namespace pharos::warp {
namespace {

/// Clamps values that rounding has moved out of [0, 1).
float primary(float u) {
  return std::clamp(u, 0.0f, kOneMinusEpsilon);
}

/// Returns the azimuth of (x, y) as a fraction of the full turn, in [0, 1).
float turn(float x, float y) {
  const float fraction = std::atan2(y, x) / (2 * kPi);
  return primary(fraction < 0 ? fraction + 1 : fraction);
}

Vec3 from_cylinder(float z, float sin_theta, float u) {
  const float phi = 2 * kPi * u;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), z};
}

}  // namespace

Vec2 square_from_disk(Vec2 p) {
  const float radius = std::sqrt(p.x * p.x + p.y * p.y);
  if (radius == 0) return {0.5f, 0.5f};
  float x, y;
  if (std::abs(p.x) > std::abs(p.y)) {
    x = std::copysign(radius, p.x);
    y = x * std::atan(p.y / p.x) * (4 / kPi);
  } else {
    y = std::copysign(radius, p.y);
    x = y * std::atan(p.x / p.y) * (4 / kPi);
  }
  return {primary(0.5f * (x + 1)), primary(0.5f * (y + 1))};
}

Vec2 square_from_cosine_hemisphere(Vec3 direction) {
  return square_from_disk({direction.x, direction.y});
}

Vec2 square_from_octahedral_hemisphere(Vec3 direction) {
  const float sum = std::abs(direction.x) + std::abs(direction.y) + direction.z;
  const float x = direction.x / sum, y = direction.y / sum;
  return {primary(0.5f * (x + y + 1)), primary(0.5f * (x - y + 1))};
}

Vec3 sphere_from_square(Vec2 u) {
  return from_cylinder(1 - 2 * u.x, 2 * safe_sqrt(u.x * (1 - u.x)), u.y);
}

Vec2 square_from_sphere(Vec3 direction) {
  return {primary(0.5f * (1 - direction.z)), turn(direction.x, direction.y)};
}

Vec3 cone_from_square(Vec2 u, float one_minus_cos) {
  const float height = u.x * one_minus_cos;
  return from_cylinder(1 - height, safe_sqrt(height * (2 - height)), u.y);
}

Vec2 triangle_from_square(Vec2 u) {
  if (u.y > u.x) return {0.5f * u.x, u.y - 0.5f * u.x};
  return {u.x - 0.5f * u.y, 0.5f * u.y};
}

double normal_from_unit(double u) {
  using boost::math::policies::policy;
  using boost::math::policies::promote_double;
  constexpr double lowest = std::numeric_limits<double>::min();
  constexpr double highest = 1 - 0x1p-53;
  // The inverse of the complementary error function has full relative accuracy in the lower tail,
  // and so has u.
  const double complement = 2 * std::clamp(u, lowest, highest);
  return -std::sqrt(2.0) * boost::math::erfc_inv(complement, policy<promote_double<false>>());
}

float fast_normal_from_unit(float u) {
  const float x = (2 * u - 1) + 0x1p-24f;
  // The product (1 - x)(1 + x) keeps the digits of both tails, unlike 1 - x^2.
  float w = -std::log((1 - x) * (1 + x)), p;
  if (w < 5) {
    w -= 2.5f;
    p = 2.81022636e-08f;
    for (const float c : {3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 2.1858087e-04f,
                          -1.25372503e-03f, -4.17768164e-03f, 0.246640727f, 1.50140941f}) {
      p = p * w + c;
    }
  } else {
    w = std::sqrt(w) - 3;
    p = -2.00214257e-04f;
    for (const float c : {1.00950558e-04f, 1.34934322e-03f, -3.67342844e-03f, 5.73950773e-03f,
                          -7.6224613e-03f, 9.43887047e-03f, 1.00167406f, 2.83297682f}) {
      p = p * w + c;
    }
  }
  constexpr float kRoot2 = 1.41421356f;
  return kRoot2 * p * x;
}

}  // namespace pharos::warp
