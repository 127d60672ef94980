// rough_conductor: a metal of GGX microfacets,
//
//     f = F(o.m) D(m) G2(o, i) / (4 cos(o) cos(i)),  m the unit half vector,
//
// with the exact Fresnel term of a complex index eta - i k in each colour channel (in vacuum).
// Light is scattered on the side of the shading normal only, once: what bounces between facets is
// lost, as usual. The default metal is copper. `masking: separable` is the product G1(o) G1(i) of
// renderers before Heitz 2014, Mitsuba 0.6 among them. Single precision resolves alpha down to
// about 0.001; below, lobes become grainy, so less than 0.0001 is refused.
//
//     { type: rough_conductor, alpha: 0.15, eta: [1.66, 0.88, 0.52], k: [9.2, 6.27, 4.84] }
#include "rough_conductor.h"

#include <pharos/config/registry.h>

#include "fresnel.h"

namespace pharos {
namespace {

/// Mean of Schlick's approximation of `normal_incidence` over the cosine-weighted hemisphere.
Rgb schlick_average(Rgb normal_incidence) {
  return normal_incidence + (Rgb(1) - normal_incidence) / 21;
}

}  // namespace

void RoughConductor::Settings::describe(Schema<Settings>& s) {
  s.field("alpha", &Settings::alpha, "GGX roughness").at_least(1e-4).at_most(1);
  s.field("eta", &Settings::eta, "Real part of the refractive index").above(0);
  s.field("k", &Settings::k, "Imaginary part of the refractive index").at_least(0);
  s.field("masking", &Settings::masking, "How masking and shadowing are combined");
  s.field("specular_reflectance", &Settings::specular_reflectance, "Factor on what is reflected")
      .otherwise("1")
      .check("at most 1 everywhere", [](const Ref<Texture>& t) { return t->maximum() <= 1; });
}

RoughConductor::RoughConductor(const Settings& settings)
    : settings_(settings),
      facets_(settings.alpha),
      average_fresnel_(schlick_average(conductor_fresnel(1, settings.eta, settings.k))) {}

ScatterValue RoughConductor::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                      ScatterOptions options) const {
  if (wo.z <= 0 || wi.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const Reflection r = reflect(point, wo, wi);
  return {r.pdf * r.weight, r.pdf};
}

std::optional<ScatterSample> RoughConductor::sample(const SurfacePoint& point, Vec3 wo, float,
                                                    Vec2 u, ScatterOptions options) const {
  if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const Vec3 m = facets_.sample_visible_normal(wo, u);
  const Vec3 wi = normalize(2 * dot(wo, m) * m - wo);
  if (!(wi.z > 0)) return {};
  const Reflection r = reflect(point, wo, wi);
  if (r.pdf == 0) return {};
  return ScatterSample{wi, Event::smooth_reflect, r.weight, r.pdf};
}

RoughConductor::Reflection RoughConductor::reflect(const SurfacePoint& point, Vec3 wo,
                                                   Vec3 wi) const {
  const Vec3 half = wo + wi;
  const float squared = length_squared(half);
  // Both directions so nearly level and opposite that no digit of the half vector is left.
  constexpr float kDegenerate = 1e-12f;
  if (squared < kDegenerate) return {};
  const Vec3 m = half / std::sqrt(squared);
  const float shadowing = settings_.masking == Masking::height_correlated
                              ? facets_.correlated_shadowing(wo, wi)
                              : facets_.masking(wi);
  const Rgb fresnel = conductor_fresnel(std::min(1.0f, dot(wo, m)), settings_.eta, settings_.k);
  return {shadowing * fresnel * settings_.specular_reflectance->evaluate(point),
          facets_.visible_reflection_pdf(wo, m)};
}

Rgb RoughConductor::albedo(const SurfacePoint& point) const {
  return average_fresnel_ * settings_.specular_reflectance->evaluate(point);
}

}  // namespace pharos
