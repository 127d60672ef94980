#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/vec.h>

namespace pharos {

/// The isotropic GGX distribution of microfacet normals with Smith masking (Walter et al. 2007,
/// "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the
/// Masking-Shadowing Function"). All directions are unit vectors with z > 0; nothing
/// divides by a cosine that may vanish.
class GgxDistribution {
 public:
  /// `alpha` in (0, 1].
  explicit GgxDistribution(float alpha) : alpha_(alpha) {}

  /// Density of facets with normal `m` over projected solid angle [1/sr].
  float density(Vec3 m) const {
    const float alpha_squared = alpha_ * alpha_;
    // The form in x and y keeps its digits for smooth surfaces, where m.z is nearly one.
    const float t = m.x * m.x + m.y * m.y + alpha_squared * m.z * m.z;
    return alpha_squared / (kPi * t * t);
  }

  /// The share G1(w) of facets' area that is visible from `w` [1] (Walter et al. 2007, eq. 34).
  float masking(Vec3 w) const { return 2 * w.z / (w.z + stretched_length(w)); }
  /// The share of the light leaving facets visible from `wo` that is not shadowed towards `wi`,
  /// G2(o, i) / G1(o) [1], with heights correlated (Heitz 2014, eq. 99). Uncorrelated it is G1(i).
  float correlated_shadowing(Vec3 wo, Vec3 wi) const {
    const float o = stretched_length(wo), i = stretched_length(wi);
    return (wo.z + o) / (o + i * (wo.z / wi.z));
  }

  /// Density of the mirror direction about a visible normal `m`: G1(o) D(m) / (4 cos(o)) [1/sr].
  float visible_reflection_pdf(Vec3 wo, Vec3 m) const {
    return 0.5f * density(m) / (wo.z + stretched_length(wo));
  }

  /// A normal visible from `wo`, of density G1(o) max(0, o.m) D(m) / cos(o) [1/sr]: spherical caps
  /// (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const {
    const Vec3 o = normalize(Vec3{alpha_ * wo.x, alpha_ * wo.y, wo.z});
    const float z = 1 - u.y * (1 + o.z);
    const float sine = safe_sqrt((1 - z) * (1 + z));
    const float phi = 2 * kPi * u.x;
    const Vec3 m = Vec3{sine * std::cos(phi), sine * std::sin(phi), z} + o;
    return normalize(Vec3{alpha_ * m.x, alpha_ * m.y, std::max(0.0f, m.z)});
  }

 private:
  /// Length of `w` in the space where the surface has roughness one: cos(w) sqrt(1 + alpha^2
  /// tan^2).
  float stretched_length(Vec3 w) const {
    return std::sqrt(alpha_ * alpha_ * (w.x * w.x + w.y * w.y) + w.z * w.z);
  }

  float alpha_;
};

}  // namespace pharos
