#pragma once

#include <cmath>

#include "facet_stretch.h"

namespace pharos {

/// Beckmann's distribution of microfacet normals, for use in Microfacets. Its slopes are Gaussian
/// (Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 25).
class BeckmannDistribution {
 public:
  /// Takes the roughness along x and along y, in (0, 1]. The roughness is the root mean square
  /// slope times the root of two.
  BeckmannDistribution(float alpha_x, float alpha_y) : stretch_(alpha_x, alpha_y) {}

  float density(Vec3 m) const {
    // Facets this steep are never drawn, and exp() hardly differs from zero here.
    constexpr float kVanishing = 80;
    const float product = stretch_.product(), squared = m.z * m.z;
    const float slope_squared = stretch_.scaled_tilt_squared(m) / (product * squared);
    if (!(slope_squared < kVanishing)) return 0;
    return std::exp(-slope_squared) / (kPi * product * squared * squared);
  }

  /// Returns cos (1 + erf(a)) / 2 + alpha sin exp(-a^2) / (2 sqrt(pi)), where a = cot / alpha and
  /// alpha is the roughness at the azimuth of `w` (Walter et al. 2007, eq. 26; Heitz 2014, eq. 80).
  float facing_area(Vec3 w) const {
    const float level = std::sqrt(stretch_.level_squared(w));
    return area_above(-w.z / level, level, w.z);
  }

  /// Draws a normal by inverting the distribution function of visible slopes.
  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const;

 private:
  /// The apparent area of the facets with normals along (s, t, 1), s > `x`, on a surface of
  /// roughness one that is seen along (sine, 0, cosine) or any multiple of this vector. `x` is at
  /// least -cosine / sine, where facets turn away. Neither term is negative, so a small area keeps
  /// its digits.
  static float area_above(float x, float sine, float cosine) {
    constexpr float kInverseRootPi = 0.564189584f;
    return 0.5f * (cosine * std::erfc(x) + kInverseRootPi * sine * std::exp(-x * x));
  }

  /// Returns the slope x, in the same view, that is exceeded by a share `above` in (0, 1] of the
  /// visible area.
  static float visible_slope(float above, float sine, float cosine);

  FacetStretch stretch_;
};

}  // namespace pharos
