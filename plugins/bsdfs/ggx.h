#pragma once

#include <algorithm>
#include <cmath>

#include "facet_stretch.h"

namespace pharos {

/// The GGX distribution of microfacet normals, also known as Trowbridge-Reitz, for use in
/// Microfacets (Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq.
/// 33).
class GgxDistribution {
 public:
  /// Takes the roughness along x and along y, in (0, 1].
  GgxDistribution(float alpha_x, float alpha_y) : stretch_(alpha_x, alpha_y) {}

  float density(Vec3 m) const {
    const float product = stretch_.product();
    // The form in x and y keeps its digits on smooth surfaces, where m.z is nearly one.
    const float t = stretch_.scaled_tilt_squared(m) + product * m.z * m.z;
    return product / (kPi * t * t);
  }

  /// Returns (cos + sqrt(cos^2 + alpha^2 sin^2)) / 2, where alpha is the roughness at the azimuth
  /// of `w` (Walter et al. 2007, eq. 34; Heitz 2014, eq. 80).
  float facing_area(Vec3 w) const {
    return 0.5f * (w.z + std::sqrt(stretch_.level_squared(w) + w.z * w.z));
  }

  /// Draws a normal by the method of spherical caps (Dupuy and Benyoub 2023, "Sampling Visible GGX
  /// Normals with Spherical Caps").
  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const {
    const Vec3 o = normalize(stretch_(wo));
    const float z = 1 - u.y * (1 + o.z);
    const float sine = safe_sqrt((1 - z) * (1 + z));
    const float phi = 2 * kPi * u.x;
    const Vec3 m = Vec3{sine * std::cos(phi), sine * std::sin(phi), z} + o;
    return normalize(stretch_({m.x, m.y, std::max(0.0f, m.z)}));
  }

 private:
  FacetStretch stretch_;
};

}  // namespace pharos
