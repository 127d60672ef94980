// rough_conductor: a metal with a microfacet surface,
//
//     f = F(o.m) D(m) G2(o, i) / (4 cos(o) cos(i)),  m the unit half vector,
//
// with the exact Fresnel term of a complex index eta - i k in each color channel (relative to
// vacuum). `material` names a measured metal (metals.cpp gives the sources) or `ideal`, which
// reflects everything. Any other metal is given by `eta` and `k` instead. Only the side of the
// shading normal scatters light, and only by single reflection: light that bounces between facets
// is lost, as usual.
//
// `distribution` is `ggx` or `beckmann`, the D of Walter et al. 2007, "Microfacet Models for
// Refraction through Rough Surfaces", eqs. 33 and 25, each with the exact masking that Smith's
// model derives from it. At equal alpha Beckmann's highlight is about as wide as the highlight of
// GGX, but it lacks the surrounding haze. `masking: separable` is the product G1(o) G1(i) of
// renderers before Heitz 2014, for example Mitsuba 0.6. Single precision resolves alpha down to
// about 0.001. Lobes become grainy below this value, and alpha below 0.0001 is rejected.
//
// If `alpha_v` is given, facets are tilted by different amounts along u and v of the texture
// coordinates. Metal brushed along u is smooth along u and rough along v, so `alpha` is less than
// `alpha_v`.
//
//     { type: rough_conductor, alpha: 0.15, material: Au }
//     { type: rough_conductor, alpha: 0.05, alpha_v: 0.3, material: Al }
//     { type: rough_conductor, alpha: 0.15, eta: [1.66, 0.88, 0.52], k: [9.2, 6.27, 4.84] }
#include "rough_conductor.h"

#include "fresnel.h"
#include "parameters.h"

namespace pharos {

void RoughConductor::Settings::describe(Schema<Settings>& s) {
  describe_brushed_facets(s);
  describe_metal(s);
  describe_factor(s, "specular_reflectance", &Settings::specular_reflectance,
                  "Factor on what is reflected");
  s.example("{ alpha: 0.02, material: Au }");
  s.example(
      "{ alpha: 0.4, material: Al, masking: separable, specular_reflectance: [0.9, 0.5, 0.2] }");
  s.example("{ alpha: 0.5, alpha_v: 0.1, material: Cu }");
  s.example("{ alpha: 0.1, alpha_v: 0.6, distribution: beckmann, material: Al }");
  s.example("{ alpha: 1, eta: [1.66, 0.88, 0.52], k: [9.2, 6.27, 4.84] }");
}

RoughConductor::RoughConductor(const Settings& settings)
    : settings_(settings),
      ior_(stated_ior(settings.material, settings.eta, settings.k)),
      facets_(settings.distribution, alpha_u(), alpha_v()),
      average_fresnel_(average_conductor_fresnel(ior_)) {}

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
  const std::optional<Vec3> m = half_vector(wo, wi);
  if (!m) return {};
  const auto [shadowing, pdf] = facets_.mirrored(wo, wi, *m, settings_.masking);
  const Rgb fresnel = conductor_fresnel(std::min(1.0f, dot(wo, *m)), ior_.eta, ior_.k);
  return {shadowing * fresnel * settings_.specular_reflectance->evaluate(point), pdf};
}

Rgb RoughConductor::albedo(const SurfacePoint& point) const {
  return average_fresnel_ * settings_.specular_reflectance->evaluate(point);
}

}  // namespace pharos
