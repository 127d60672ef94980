#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <pharos/config/values.h>
#include <pharos/core/vec.h>

namespace pharos {

/// How masking towards the sensor and shadowing towards the light go together.
enum class Masking {
  height_correlated,  ///< facets that are high are seen and lit more often (Heitz 2014)
  separable,  ///< as if independent, as older renderers have it: what is reflected comes out
              ///< darker, what is refracted brighter
};
template <>
struct EnumNames<Masking> {
  static constexpr std::array<std::pair<std::string_view, Masking>, 2> names{
      {{"height_correlated", Masking::height_correlated}, {"separable", Masking::separable}}};
};

/// The unit vector halfway between two directions with z > 0; nothing where both are so nearly
/// level and opposite that no digit of it is left.
inline std::optional<Vec3> half_vector(Vec3 wo, Vec3 wi) {
  const Vec3 half = wo + wi;
  const float squared = length_squared(half);
  constexpr float kDegenerate = 1e-12f;
  if (squared < kDegenerate) return {};
  return half / std::sqrt(squared);
}

/// Euler's beta function B(a, b) for a, b in [1, 1e18], to about 1e-5 of its value: Stirling's
/// formula for all three Gamma functions, joined so that large arguments do not cancel.
inline float beta_function(float a, float b) {
  // One recurrence step, B(a, b) = B(a+1, b+1) (a+b) (a+b+1) / (a b), to where the remainder's
  // continued fraction (Stieltjes 1894) is short.
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
/// All directions are unit vectors with z > 0 but where said otherwise; nothing divides by a cosine
/// that may vanish. `Distribution` says how facets are tilted:
///
/// - density(m): density D of facets with normal `m` over projected solid angle [1/sr];
/// - facing_area(w): cos(w) (1 + Lambda(w)), the area of all facets that face `w`, masked or not,
///   as it appears from there and per area of the surface [1];
/// - sample_visible_normal(wo, u): a normal visible from `wo`, of density visible_normal_pdf().
/// Where
///   wo.y is zero, u.x and 1 - u.x give mirror images; u.y near one draws the facets that turn away
///   from view.
template <class Distribution>
class Microfacets {
 public:
  explicit Microfacets(const Distribution& distribution) : distribution_(distribution) {}

  float density(Vec3 m) const { return distribution_.density(m); }

  /// The share G1(w) of facets' area that is visible from `w` [1].
  float masking(Vec3 w) const { return w.z / distribution_.facing_area(w); }
  /// The share of the light leaving facets visible from `wo` that is not shadowed towards `wi`,
  /// G2(o, i) / G1(o) [1], with heights correlated (Heitz 2014, eq. 99). Uncorrelated it is G1(i).
  float correlated_shadowing(Vec3 wo, Vec3 wi) const {
    const float o = distribution_.facing_area(wo), i = distribution_.facing_area(wi);
    return o / (o + (i - wi.z) * (wo.z / wi.z));
  }
  /// The same for light that leaves downwards, `wi.z` < 0. At a height below which the share c of
  /// all facets lies, c^Lambda(o) are unmasked from above and (1 - c)^Lambda(i) unshadowed from
  /// below; the mean over c is G2 = B(1 + Lambda(o), 1 + Lambda(i)) (Heitz et al. 2016,
  /// "Multiple-Scattering Microfacet BSDFs with the Smith Model"). Uncorrelated it is G1(-i).
  float correlated_shadowing_below(Vec3 wo, Vec3 wi) const {
    const float o = 1 + lambda(wo), i = 1 + lambda(-wi);
    return std::min(1.0f, o * beta_function(o, i));
  }

  /// G2(o, i) / G1(o) [1] with the given `masking`, towards `wi` above or below.
  float shadowing(Vec3 wo, Vec3 wi, Masking masking) const {
    if (masking == Masking::separable) return this->masking(wi.z > 0 ? wi : -wi);
    return wi.z > 0 ? correlated_shadowing(wo, wi) : correlated_shadowing_below(wo, wi);
  }

  /// Density of a visible normal `m` with o.m > 0: G1(o) o.m D(m) / cos(o) [1/sr].
  float visible_normal_pdf(Vec3 wo, Vec3 m) const {
    return 4 * dot(wo, m) * visible_reflection_pdf(wo, m);
  }

  /// Density of the mirror direction about a visible normal `m`: G1(o) D(m) / (4 cos(o)) [1/sr].
  float visible_reflection_pdf(Vec3 wo, Vec3 m) const {
    return 0.25f * density(m) / distribution_.facing_area(wo);
  }

  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const {
    return distribution_.sample_visible_normal(wo, u);
  }

 private:
  /// Smith's Lambda, 1 / G1 - 1, cut off where float arithmetic would overflow and G2 has long
  /// vanished.
  float lambda(Vec3 w) const {
    return std::clamp(distribution_.facing_area(w) / w.z - 1, 0.0f, 1e17f);
  }

  Distribution distribution_;
};

}  // namespace pharos
