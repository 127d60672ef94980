#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <pharos/config/values.h>
#include <pharos/core/vec.h>

namespace pharos {

/// How masking towards the sensor and shadowing towards the light are combined.
enum class Masking {
  height_correlated,  ///< high facets are both seen and lit more often (Heitz 2014)
  separable,  ///< as if independent, as in older renderers: reflected light gets darker, refracted
              ///< light brighter
};
template <>
struct EnumNames<Masking> {
  static constexpr auto names = std::to_array<EnumName<Masking>>(
      {{"height_correlated", Masking::height_correlated}, {"separable", Masking::separable}});
};

/// Returns the unit vector halfway between two directions with z > 0. Empty if both are so nearly
/// horizontal and opposite that rounding leaves no digit of the result.
inline std::optional<Vec3> half_vector(Vec3 wo, Vec3 wi) {
  const Vec3 half = wo + wi;
  const float squared = length_squared(half);
  constexpr float kDegenerate = 1e-12f;
  if (squared < kDegenerate) return {};
  return half / std::sqrt(squared);
}

/// Euler's beta function B(a, b) for a, b in [1, 1e18], with a relative error of about 1e-5. It
/// applies Stirling's formula to all three Gamma functions, combined so that large arguments do not
/// cancel.
inline float beta_function(float a, float b) {
  // One recurrence step, B(a, b) = B(a+1, b+1) (a+b) (a+b+1) / (a b), leads to arguments for which
  // the continued fraction of the remainder (Stieltjes 1894) is short.
  const float x = a + 1, y = b + 1, sum = x + y;
  const auto remainder = [](float z) {
    return (1.0f / 12) / (z + (1.0f / 30) / (z + (53.0f / 210) / (z + (195.0f / 371) / z)));
  };
  constexpr float kHalfLogTwoPi = 0.918938533f;
  const float log_beta = kHalfLogTwoPi - (x - 0.5f) * std::log1p(y / x) -
                         (y - 0.5f) * std::log1p(x / y) - 0.5f * std::log(sum) + remainder(x) +
                         remainder(y) - remainder(sum);
  return (sum - 2) * (sum - 1) / (a * b) * std::exp(log_beta);
}

/// A surface of microfacets with Smith masking (Walter et al. 2007, "Microfacet Models for
/// Refraction through Rough Surfaces"; Heitz 2014, "Understanding the Masking-Shadowing Function").
/// All directions are unit vectors with z > 0 unless stated otherwise. No function divides by a
/// cosine that may vanish. `Distribution` describes how facets are tilted:
///
///   - density(m): the density D of facets with normal `m` over projected solid angle [1/sr];
///   - facing_area(w): cos(w) (1 + Lambda(w)), the apparent area of all facets that face `w`,
///     masked or not, per area of the surface [1];
///   - sample_visible_normal(wo, u): draws a normal visible from `wo` with the density
///     visible_normal_pdf(). If wo.y is zero, u.x and 1 - u.x give mirror images. Values of u.y
///     near one draw the facets that turn away from view.
template <class Distribution>
class Microfacets {
 public:
  explicit Microfacets(const Distribution& distribution) : distribution_(distribution) {}

  float density(Vec3 m) const { return distribution_.density(m); }

  /// The share G1(w) of the facets' area that is visible from `w` [1].
  float masking(Vec3 w) const { return w.z / distribution_.facing_area(w); }
  /// The share of the light leaving facets visible from `wo` that is not shadowed towards `wi`:
  /// G2(o, i) / G1(o) [1] with correlated heights (Heitz 2014, eq. 99). Without correlation it is
  /// G1(i).
  float correlated_shadowing(Vec3 wo, Vec3 wi) const {
    const float o = distribution_.facing_area(wo), i = distribution_.facing_area(wi);
    return o / (o + (i - wi.z) * (wo.z / wi.z));
  }
  /// Like correlated_shadowing(), but for light that leaves downwards, `wi.z` < 0. At a height
  /// below which a share c of all facets lies, a share c^Lambda(o) of facets is unmasked from above
  /// and a share (1 - c)^Lambda(i) is unshadowed from below. The mean over c is
  /// G2 = B(1 + Lambda(o), 1 + Lambda(i)) (Heitz et al. 2016, "Multiple-Scattering Microfacet BSDFs
  /// with the Smith Model"). Without correlation the result is G1(-i).
  float correlated_shadowing_below(Vec3 wo, Vec3 wi) const {
    const float o = 1 + lambda(wo), i = 1 + lambda(-wi);
    return std::min(1.0f, o * beta_function(o, i));
  }

  /// G2(o, i) / G1(o) [1] for the given `masking`; `wi` lies above or below.
  float shadowing(Vec3 wo, Vec3 wi, Masking masking) const {
    if (masking == Masking::separable) return this->masking(wi.z > 0 ? wi : -wi);
    return wi.z > 0 ? correlated_shadowing(wo, wi) : correlated_shadowing_below(wo, wi);
  }

  /// The density of a visible normal `m` with o.m > 0: G1(o) o.m D(m) / cos(o) [1/sr].
  float visible_normal_pdf(Vec3 wo, Vec3 m) const {
    return 4 * dot(wo, m) * visible_reflection_pdf(wo, m);
  }

  /// The density of the mirror direction about a visible normal `m`: G1(o) D(m) / (4 cos(o))
  /// [1/sr].
  float visible_reflection_pdf(Vec3 wo, Vec3 m) const {
    return 0.25f * density(m) / distribution_.facing_area(wo);
  }

  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const {
    return distribution_.sample_visible_normal(wo, u);
  }

 private:
  /// Smith's Lambda, 1 / G1 - 1. It is clamped before float arithmetic overflows; G2 is practically
  /// zero there.
  float lambda(Vec3 w) const {
    return std::clamp(distribution_.facing_area(w) / w.z - 1, 0.0f, 1e17f);
  }

  Distribution distribution_;
};

}  // namespace pharos
