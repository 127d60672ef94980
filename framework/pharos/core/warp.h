#pragma once

#include <pharos/core/frame.h>
#include <pharos/core/vec.h>

/// Maps from primary numbers u in [0,1)^2 to the domains of rendering, each with its density.
/// `X_from_square` warps; `X_pdf` is the density of its result; where there is an inverse,
/// `square_from_X` undoes the warp.
namespace pharos::warp {

/// Polar coordinates of the concentric map: squares about the center become circles.
struct ConcentricPoint {
  float radius;  ///< signed, in [-1, 1]
  Vec2 direction;
};

/// The concentric map of `u` (Shirley and Chiu 1997). Its angle lies within 45 degrees of an axis,
/// where short Taylor series give sine and cosine to float precision.
inline ConcentricPoint concentric_from_square(Vec2 u) {
  const float x = 2 * u.x - 1, y = 2 * u.y - 1;
  const bool along_x = std::abs(x) > std::abs(y);
  const float radius = along_x ? x : y;
  if (radius == 0) return {0, {1, 0}};
  const float t = kPi / 4 * ((along_x ? y : x) / radius), t2 = t * t;
  const float s =
      t * (1 + t2 * (-1.0f / 6 + t2 * (1.0f / 120 + t2 * (-1.0f / 5040 + t2 / 362880))));
  const float c =
      1 + t2 * (-0.5f + t2 * (1.0f / 24 + t2 * (-1.0f / 720 + t2 * (1.0f / 40320 - t2 / 3628800))));
  return {radius, along_x ? Vec2{c, s} : Vec2{s, c}};
}

/// Unit disk, area-preserving concentric map (Shirley and Chiu 1997). Density 1/pi [1/unit area].
inline Vec2 disk_from_square(Vec2 u) {
  const ConcentricPoint p = concentric_from_square(u);
  return p.radius * p.direction;
}
/// Inverse of disk_from_square.
Vec2 square_from_disk(Vec2 p);
constexpr float disk_pdf() {
  return 1 / kPi;
}

/// The unit direction at an angle of 1 - cos = `one_minus_cos`, in [0, 2], to +z, turned around it
/// by `turn` of a full turn.
inline Vec3 about_z(float one_minus_cos, float turn) {
  const float sine = safe_sqrt(one_minus_cos * (2 - one_minus_cos));
  const float phi = 2 * kPi * turn;
  return {sine * std::cos(phi), sine * std::sin(phi), 1 - one_minus_cos};
}

/// Cosine-weighted direction about +z. Density cosine_hemisphere_pdf [1/sr].
inline Vec3 cosine_hemisphere_from_square(Vec2 u) {
  const ConcentricPoint p = concentric_from_square(u);
  const Vec2 foot = p.radius * p.direction;
  // (1 - r)(1 + r) rather than 1 - r^2 keeps the digits of grazing directions.
  return {foot.x, foot.y, safe_sqrt((1 - p.radius) * (1 + p.radius))};
}
/// Inverse of cosine_hemisphere_from_square for unit directions with z >= 0.
Vec2 square_from_cosine_hemisphere(Vec3 direction);
constexpr float cosine_hemisphere_pdf(float cos_theta) {
  return cos_theta > 0 ? cos_theta / kPi : 0.0f;
}

/// Direction of the hemisphere about +z by way of an octahedron: the square is folded to the upper
/// four faces of |x| + |y| + |z| = 1, which are seen from the origin (Engelhardt and Dachsbacher
/// 2008, "Octahedron Environment Maps"). Within a face straight lines of the square become great
/// circles, the images of straight edges. Density octahedral_hemisphere_pdf [1/sr].
inline Vec3 octahedral_hemisphere_from_square(Vec2 u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  // The diamond |x| + |y| <= 1 is the square turned by 45 degrees.
  return normalize(Vec3{0.5f * (a + b), 0.5f * (a - b), 1 - std::max(std::abs(a), std::abs(b))});
}
/// Inverse of octahedral_hemisphere_from_square for unit directions with z >= 0.
Vec2 square_from_octahedral_hemisphere(Vec3 direction);
/// A face lies 1 / (|x| + |y| + z) away along a unit direction, and the square has twice the faces'
/// area seen along z: from 0.096 where x = y = z to 0.5 along the axes [1/sr].
inline float octahedral_hemisphere_pdf(Vec3 direction) {
  const float sum = std::abs(direction.x) + std::abs(direction.y) + direction.z;
  return direction.z > 0 ? 0.5f / (sum * sum * sum) : 0.0f;
}

/// Uniform direction. Density 1/(4 pi) [1/sr].
Vec3 sphere_from_square(Vec2 u);
/// Inverse of sphere_from_square for unit directions.
Vec2 square_from_sphere(Vec3 direction);
constexpr float sphere_pdf() {
  return 1 / (4 * kPi);
}

/// Uniform direction in the cone about +z whose half-angle has `one_minus_cos` = 1 - cos(angle);
/// given that way so that narrow cones keep their digits. Density cone_pdf [1/sr].
Vec3 cone_from_square(Vec2 u, float one_minus_cos);
constexpr float cone_pdf(float one_minus_cos) {
  return 1 / (2 * kPi * one_minus_cos);
}

/// Barycentric weights (b1, b2) of vertices 1 and 2, uniform over a triangle's area
/// (Heitz 2019, "A Low-Distortion Map Between Triangle and Square"). Density 1/area [1/m^2].
Vec2 triangle_from_square(Vec2 u);

/// Standard normal quantile, the map from (0,1) to a unit Gaussian. Double, about 1e-15 accurate;
/// 0 and 1 are taken as the nearest doubles inside, so that the result is always finite.
double normal_from_unit(double u);

/// The same of a primary number u in [0,1), which stands for the middle of its 24-bit cell, in
/// single precision: within 5.5 of zero, error below 3e-6 times the larger of one and the result.
/// Two polynomials (Giles 2011, "Approximating the erfinv function").
float fast_normal_from_unit(float u);

}  // namespace pharos::warp
