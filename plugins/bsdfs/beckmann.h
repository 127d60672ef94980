#pragma once

#include <cmath>

#include "facet_stretch.h"

namespace pharos {

/// Beckmann's distribution of microfacet normals, whose slopes are Gaussian (Walter et al. 2007,
/// "Microfacet Models for Refraction through Rough Surfaces", eq. 25), for Microfacets.
class BeckmannDistribution {
 public:
  /// Roughness along x and along y, in (0, 1]: the root mean square slope times the root of two.
  BeckmannDistribution(float alpha_x, float alpha_y) : stretch_(alpha_x, alpha_y) {}

  float density(Vec3 m) const {
    // Steeper facets than any that is drawn, and near what exp() cannot tell from zero.
    constexpr float kVanishing = 80;
    const float product = stretch_.product(), squared = m.z * m.z;
    const float slope_squared = stretch_.scaled_tilt_squared(m) / (product * squared);
    if (!(slope_squared < kVanishing)) return 0;
    return std::exp(-slope_squared) / (kPi * product * squared * squared);
  }

  /// cos (1 + erf(a)) / 2 + alpha sin exp(-a^2) / (2 sqrt(pi)), where a = cot / alpha and alpha is
  /// that of the azimuth of `w` (Walter et al. 2007, eq. 26; Heitz 2014, eq. 80).
  float facing_area(Vec3 w) const {
    const float level = std::sqrt(stretch_.level_squared(w));
    return area_above(-w.z / level, level, w.z);
  }

  /// By inversion of the distribution function of visible slopes.
  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const;

 private:
  /// On a surface of roughness one, seen along (sine, 0, cosine) or any multiple of it: the area of
  /// facets with normals along (s, t, 1), s > `x`, as it appears from there. `x` is no less than
  /// -cosine / sine, where facets turn away. No term is negative: no digits are lost where the area
  /// is small.
  static float area_above(float x, float sine, float cosine) {
    constexpr float kInverseRootPi = 0.564189584f;
    return 0.5f * (cosine * std::erfc(x) + kInverseRootPi * sine * std::exp(-x * x));
  }

  /// The slope x in that view that a share `above` in (0, 1] of the area facing it exceeds.
  static float visible_slope(float above, float sine, float cosine);

  FacetStretch stretch_;
};

}  // namespace pharos
