#include "round_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos {
namespace {

/// The largest difference of the scales along the three axes, and the largest cosine between the
/// axes, of a map that counts as uniform. Products of rotations in float remain far below it.
constexpr float kSimilarityTolerance = 1e-4f;

}  // namespace

std::optional<float> even_scale(const Transform& map) {
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0}), z = map.vector({0, 0, 1});
  const float scale = length(x);
  const float skew = max_component(Vec3{abs_dot(x, y), abs_dot(y, z), abs_dot(z, x)});
  const float difference = std::max(std::abs(length(y) - scale), std::abs(length(z) - scale));
  const bool even =
      skew <= kSimilarityTolerance * scale * scale && difference <= kSimilarityTolerance * scale;
  return even ? std::optional(scale) : std::nullopt;
}

std::optional<std::array<double, 2>> distance_roots(Double3 origin, Double3 direction,
                                                    double radius) {
  const double a = dot(direction, direction), b = dot(origin, direction);
  if (a == 0) return std::nullopt;
  // Computes the discriminant from the distance between the line and the center, because b^2 - a c
  // would cancel far away (Haines et al. 2019, "Precision Improvements for Ray/Sphere
  // Intersection").
  const Double3 closest = origin + (-b / a) * direction;
  const double discriminant = radius * radius - dot(closest, closest);
  if (discriminant < 0) return std::nullopt;
  const double q = -b - std::copysign(std::sqrt(a * discriminant), b);
  const double near = q / a;
  const double other = q != 0 ? (dot(origin, origin) - radius * radius) / q : near;
  return std::array{std::min(near, other), std::max(near, other)};
}

float azimuth_fraction(float x, float y) {
  const float fraction = std::atan2(y, x) / (2 * kPi);
  return fraction < 0 ? fraction + 1 : fraction;
}

Bounds3 bounds_around(Point3 center, Vec3 reach) {
  Bounds3 box;
  for (int i = 0; i < 3; ++i) {
    box.low[i] = std::nextafter(center[i] - reach[i], -kInfinity);
    box.high[i] = std::nextafter(center[i] + reach[i], kInfinity);
  }
  return box;
}

float exact_shape_error(float coordinate) {
  // The position and the ray origin are each rounded once, by at most half an epsilon of a
  // coordinate. Together this is sqrt(3) epsilons in three dimensions. With four epsilons no ray is
  // on the wrong side, because the error of the intersection itself is negligible in comparison.
  return 4 * std::numeric_limits<float>::epsilon() * coordinate;
}

}  // namespace pharos
