#pragma once

#include <pharos/core/frame.h>
#include <pharos/core/vec.h>

/// Maps from primary numbers u in [0,1)^2 to the domains of rendering, each with its density.
/// `X_from_square` warps, and `X_pdf` returns the density of its result. If there is an inverse,
/// `square_from_X` undoes the warp.
namespace pharos::warp {

/// Polar coordinates of a point under the concentric map, which turns squares about the center into
/// circles.
struct ConcentricPoint {
  float radius;  ///< signed radius in [-1, 1]
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

/// Maps to the unit disk by the area-preserving concentric map (Shirley and Chiu 1997). The density
/// is 1/pi [1/unit area].
inline Vec2 disk_from_square(Vec2 u) {
  const ConcentricPoint p = concentric_from_square(u);
  return p.radius * p.direction;
}
/// Inverse of disk_from_square.
Vec2 square_from_disk(Vec2 p);
constexpr float disk_pdf() {
  return 1 / kPi;
}

/// Returns the unit direction whose angle to +z has 1 - cos = `one_minus_cos`, in [0, 2], rotated
/// about +z by `turn` of a full turn.
inline Vec3 about_z(float one_minus_cos, float turn) {
  const float sine = safe_sqrt(one_minus_cos * (2 - one_minus_cos));
  const float phi = 2 * kPi * turn;
  return {sine * std::cos(phi), sine * std::sin(phi), 1 - one_minus_cos};
}

/// Maps to a cosine-weighted direction about +z. The density is cosine_hemisphere_pdf [1/sr].
inline Vec3 cosine_hemisphere_from_square(Vec2 u) {
  const ConcentricPoint p = concentric_from_square(u);
  const Vec2 foot = p.radius * p.direction;
  // The product (1 - r)(1 + r) keeps the digits of grazing directions, unlike 1 - r^2.
  return {foot.x, foot.y, safe_sqrt((1 - p.radius) * (1 + p.radius))};
}
/// Inverse of cosine_hemisphere_from_square for unit directions with z >= 0.
Vec2 square_from_cosine_hemisphere(Vec3 direction);
constexpr float cosine_hemisphere_pdf(float cos_theta) {
  return cos_theta > 0 ? cos_theta / kPi : 0.0f;
}

/// Maps to a direction of the hemisphere about +z by an octahedron. The square is folded to the
/// upper four faces of |x| + |y| + |z| = 1, which are then projected to directions from the origin
/// (Engelhardt and Dachsbacher 2008, "Octahedron Environment Maps"). Within a face, straight lines
/// of the square become great circles. The images of straight edges are great circles, too. The
/// density is octahedral_hemisphere_pdf [1/sr].
inline Vec3 octahedral_hemisphere_from_square(Vec2 u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  // The diamond |x| + |y| <= 1 is the square rotated by 45 degrees.
  return normalize(Vec3{0.5f * (a + b), 0.5f * (a - b), 1 - std::max(std::abs(a), std::abs(b))});
}
/// Inverse of octahedral_hemisphere_from_square for unit directions with z >= 0.
Vec2 square_from_octahedral_hemisphere(Vec3 direction);
/// The density of octahedral_hemisphere_from_square: from 0.096 at x = y = z to 0.5 along the axes
/// [1/sr]. The distance to the face along a unit direction is 1 / (|x| + |y| + z), and the faces
/// projected along z have twice the area of the unit square.
inline float octahedral_hemisphere_pdf(Vec3 direction) {
  const float sum = std::abs(direction.x) + std::abs(direction.y) + direction.z;
  return direction.z > 0 ? 0.5f / (sum * sum * sum) : 0.0f;
}

/// Maps to a uniform direction. The density is 1/(4 pi) [1/sr].
Vec3 sphere_from_square(Vec2 u);
/// Inverse of sphere_from_square for unit directions.
Vec2 square_from_sphere(Vec3 direction);
constexpr float sphere_pdf() {
  return 1 / (4 * kPi);
}

/// Maps to a uniform direction in the cone about +z whose half-angle has 1 - cos(angle) =
/// `one_minus_cos`. This parameter keeps the digits of narrow cones. The density is cone_pdf
/// [1/sr].
Vec3 cone_from_square(Vec2 u, float one_minus_cos);
constexpr float cone_pdf(float one_minus_cos) {
  return 1 / (2 * kPi * one_minus_cos);
}

/// Maps to barycentric weights (b1, b2) of vertices 1 and 2, uniform over the area of a triangle
/// (Heitz 2019, "A Low-Distortion Map Between Triangle and Square"). The density is 1/area [1/m^2].
Vec2 triangle_from_square(Vec2 u);

/// Returns the standard normal quantile, which maps (0,1) to a unit Gaussian. Computes in double
/// precision, with an accuracy of about 1e-15. Takes 0 and 1 as the nearest doubles inside the
/// interval, so the result is always finite.
double normal_from_unit(double u);

/// Returns the standard normal quantile of a primary number u in [0,1) in single precision. The
/// number u stands for the middle of its 24-bit cell. The result lies within 5.5 of zero. Its error
/// is below 3e-6 times the larger of one and the result. Uses two polynomials (Giles 2011,
/// "Approximating the erfinv function").
float fast_normal_from_unit(float u);

}  // namespace pharos::warp
