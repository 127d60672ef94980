#include "beckmann.h"

#include <algorithm>

#include <pharos/core/warp.h>

namespace pharos {
namespace {

/// Returns the slope that is exceeded by a share `above` of slopes. Slopes have the density
/// exp(-x^2) / sqrt(pi).
float gaussian_slope(float above) {
  return -std::sqrt(0.5f) * static_cast<float>(warp::normal_from_unit(double{above}));
}

}  // namespace

// Seen along (sine, 0, cosine), facets with normals along (x, y, 1) have the unnormalized density
//
//     (cosine + x sine) exp(-x^2 - y^2) / pi,    x > -cosine / sine.
//
// The slope y is Gaussian, and x is independent of y (Heitz and d'Eon 2014, "Importance Sampling
// Microfacet-Based BSDFs using the Distribution of Visible Normals"; Jakob 2014, "An Improved
// Visible Normal Sampling Routine for the Beckmann Distribution").

/// The slope lies between two limits: the Gaussian slope seen from straight above, and the slope at
/// grazing view, where area_above() is proportional to exp(-x^2). The search starts from a mean of
/// both, which is exact at both ends. Halley's method then finds the slope to within rounding,
/// mostly in two steps.
float BeckmannDistribution::visible_slope(float above, float sine, float cosine) {
  constexpr int kMostSteps = 10;
  constexpr float kLastStep = 1e-3f;  // leaves an error of its third power
  constexpr float kInverseRootPi = 0.564189584f;
  const float cotangent = cosine / sine;
  const float target = above * area_above(-cotangent, sine, cosine);
  const float lowest = std::max(-cotangent, gaussian_slope(above));
  const float highest = std::sqrt(-std::log(above));
  float x = lerp(lowest, highest, sine / (sine + cosine));
  for (int i = 0; i < kMostSteps; ++i) {
    const float density = kInverseRootPi * std::exp(-x * x) * (cosine + x * sine);
    if (!(density > 0)) break;  // end of the visible slopes
    const float newton = (area_above(x, sine, cosine) - target) / density;
    const float room = cotangent + x;
    const float curved = 1 + 0.5f * newton * (1 / room - 2 * x);
    constexpr float kLeastCurved = 0.5f;  // guards against meaningless values far from the solution
    const float next = std::clamp(x + newton / std::max(kLeastCurved, curved), lowest, highest);
    const float step = std::abs(next - x);
    x = next;
    if (step < kLastStep * std::min(1.0f, room)) break;
  }
  return x;
}

Vec3 BeckmannDistribution::sample_visible_normal(Vec3 wo, Vec2 u) const {
  constexpr float kLeast = 0x1p-25f;  // half of the spacing of the random numbers
  const Vec3 o = stretch_(wo);
  const float level = std::sqrt(stretch_.level_squared(wo));
  const float x = visible_slope(std::max(kLeast, u.y), level, wo.z);
  const float y = gaussian_slope(std::max(kLeast, u.x));
  const float cos_azimuth = level > 0 ? o.x / level : 1, sin_azimuth = level > 0 ? o.y / level : 0;
  return normalize(
      stretch_({x * cos_azimuth - y * sin_azimuth, x * sin_azimuth + y * cos_azimuth, 1}));
}

}  // namespace pharos
