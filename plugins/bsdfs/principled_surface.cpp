#include "principled_surface.h"

#include <cmath>

#include "fresnel.h"
#include "ggx.h"
#include "microfacet.h"

namespace pharos {
namespace {

/// Returns Schlick's weight of grazing reflectance, (1 - cosine)^5 (Schlick 1994, "An Inexpensive
/// BRDF Model for Physically-based Rendering").
float schlick_weight(float cosine) {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  return square(square(m)) * m;
}

Rgb schlick_fresnel(Rgb normal_incidence, float weight) {
  return normal_incidence + weight * (Rgb(1) - normal_incidence);
}

float coat_fresnel(float cosine) {
  constexpr float kNormalIncidence = 0.04f;  // for an index of 1.5
  return lerp(kNormalIncidence, 1, schlick_weight(cosine));
}

}  // namespace

float CoatDistribution::density(Vec3 m) const {
  const float squared = alpha_ * alpha_;
  // The form in x and y keeps its digits where m.z is nearly one.
  const float t = m.x * m.x + m.y * m.y + squared * m.z * m.z;
  return (squared - 1) / (kPi * std::log(squared) * t);
}

Vec3 CoatDistribution::sample(Vec2 u) const {
  const float squared = alpha_ * alpha_;
  const float sine_squared = squared * std::expm1(-u.y * std::log(squared)) / (1 - squared);
  const float sine = std::sqrt(sine_squared), phi = 2 * kPi * u.x;
  return normalize(Vec3{sine * std::cos(phi), sine * std::sin(phi), safe_sqrt(1 - sine_squared)});
}

/// The base color scaled to luminance one.
Rgb PrincipledSurface::tint() const {
  const float brightness = luminance(base_color);
  return brightness > 0 ? base_color / brightness : Rgb(1);
}

PrincipledSurface::Shares PrincipledSurface::shares(float dielectric, float schlick,
                                                    bool outside) const {
  const Rgb transmitted{std::sqrt(base_color.r), std::sqrt(base_color.g), std::sqrt(base_color.b)};
  const Rgb through = clear_weight() * (1 - dielectric) * transmitted;
  if (!outside) return {Rgb(clear_weight() * dielectric), through};
  Rgb reflected = (1 - metallic) * (1 - spec_tint) * Rgb(dielectric);
  if (metallic > 0) reflected += metallic * schlick_fresnel(base_color, schlick);
  if (spec_tint > 0) {
    Rgb tinted = square((ior - 1) / (ior + 1)) * tint();
    for (int c = 0; c < 3; ++c) tinted[c] = std::min(1.0f, tinted[c]);
    reflected += (1 - metallic) * spec_tint * schlick_fresnel(tinted, schlick);
  }
  return {reflected, through};
}

PrincipledSurface::Shares PrincipledSurface::shares_at(float cosine, float dielectric,
                                                       bool outside) const {
  // Into a thinner medium the weight uses the refracted angle, so that it is one at total
  // reflection.
  const bool thinner = ior < 1 && outside;
  const float angle = thinner ? dielectric_fresnel(cosine, ior).cos_transmitted : cosine;
  return shares(dielectric, schlick_weight(angle), outside);
}

Rgb PrincipledSurface::sheen_color() const {
  return sheen * (1 - metallic) * (Rgb(1 - sheen_tint) + sheen_tint * tint());
}

Rgb PrincipledSurface::matt(Vec3 wo, Vec3 wi, Vec3 m) const {
  const float grazing_o = schlick_weight(wo.z), grazing_i = schlick_weight(wi.z);
  const float cos_d = dot(wi, m), retro = 2 * roughness * cos_d * cos_d;
  const float rough = (1 - 0.5f * grazing_o) * (1 - 0.5f * grazing_i) +
                      retro * (grazing_o + grazing_i + grazing_o * grazing_i * (retro - 1));
  const float flat = lerp(1, 0.5f * retro, grazing_o) * lerp(1, 0.5f * retro, grazing_i);
  // The factor cos(i) is included, because the term is unbounded without it.
  const float below = 1.25f * (flat * (wi.z / (wo.z + wi.z) - 0.5f * wi.z) + 0.5f * wi.z);
  const Rgb base = matt_weight() / kPi * lerp(wi.z * rough, below, flatness) * base_color;
  return sheen > 0 ? base + wi.z * schlick_weight(cos_d) * sheen_color() : base;
}

float PrincipledSurface::matt_albedo() const {
  constexpr float kSheen = 0.05f;  // between 0.001 at normal and 0.09 at grazing incidence
  return matt_weight() * mean(base_color) + kSheen * mean(sheen_color());
}

float PrincipledSurface::coat(Vec3 wo, Vec3 wi, Vec3 m) const {
  if (clearcoat == 0) return 0;
  constexpr float kAlpha = 0.25f;  // Burley 2012
  const Microfacets shadows(GgxDistribution(kAlpha, kAlpha));
  return 0.25f * clearcoat * coat_fresnel(dot(wo, m)) * coat_facets().density(m) *
         shadows.masking(wo) * shadows.masking(wi) * wi.z;
}

float PrincipledSurface::coat_albedo(Vec3 wo) const {
  return clearcoat * coat_fresnel(wo.z) * wo.z;
}

}  // namespace pharos
