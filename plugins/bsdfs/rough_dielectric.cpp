// rough_dielectric: frosted glass, the interface of a clear medium with a microfacet surface
// (Walter et al. 2007, eqs. 20 and 21):
//
//     reflected   f = F(o.m) D(m) G2(o, i) / (4 cos(o) cos(i)),      m ~ o + i,
//     refracted   f = (1 - F(o.m)) D(m) G2(o, i) |o.m| |i.m|
//                     / (cos(o) cos(i) |o + eta i|^2),               m ~ -+(o + eta i),
//
// where eta is the index on the side of i over the index on the side of o. These values are for
// paths from the sensor; paths from a light have another factor eta^2 (conventions.md). sample()
// first draws a facet among those visible from o; F then determines the choice between reflection
// and refraction. A set of allowed events conditions only this choice. Light that bounces between
// facets is lost, as usual. `masking: separable` is the product G1(o) G1(i) of Walter et al., as
// for example in Mitsuba 0.6.
//
// `alpha_v` and `distribution` have the same meaning as in rough_conductor.
//
// The refracted lobe becomes narrower as `ior` approaches one, and at one it is a single direction.
// If alpha |ior - 1| is less than 3e-5, single precision no longer resolves the lobe, and the
// material is rejected. Use `dielectric` or a surface without material then.
//
//     { type: rough_dielectric, alpha: 0.2, ior: 1.5 }
#include "rough_dielectric.h"

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "parameters.h"
#include "rough_interface.h"

namespace pharos {
namespace {

/// The probability that a facet of reflectance `fresnel` mirrors, given the `allowed` events.
float reflect_probability(float fresnel, EventMask allowed) {
  if (!contains(allowed, Event::smooth_reflect)) return 0;
  return contains(allowed, Event::smooth_transmit) ? fresnel : 1;
}
/// The probability that a facet of reflectance `fresnel` refracts, given the `allowed` events.
float refract_probability(float fresnel, EventMask allowed) {
  if (!contains(allowed, Event::smooth_transmit)) return 0;
  return contains(allowed, Event::smooth_reflect) ? 1 - fresnel : 1;
}

}  // namespace

void RoughDielectric::Settings::describe(Schema<Settings>& s) {
  describe_brushed_facets(s);
  describe_ior(s, "Refractive index inside over outside");
  describe_both_factors(s, "refracted");
  s.example("{ alpha: 0.02, ior: 1.33 }");
  s.example("{ alpha: 0.3, ior: 0.66, masking: separable }");
  s.example(
      "{ alpha: 1, ior: 2.4, specular_reflectance: 0.8, specular_transmittance: [0.2, 0.7, 1] }");
  s.example("{ alpha: 0.2, ior: 1.02 }");
  s.example("{ alpha: 0.05, alpha_v: 0.4 }");
  s.example("{ alpha: 0.7, alpha_v: 0.1, distribution: beckmann, ior: 0.7 }");
}

RoughDielectric::RoughDielectric(const Settings& settings)
    : settings_(settings),
      facets_(settings.distribution, alpha_u(), alpha_v()),
      average_fresnel_(average_dielectric_fresnel(settings.ior)) {
  constexpr float kNarrowest = 3e-5f;
  const float width = std::min(alpha_u(), alpha_v()) * std::abs(settings.ior - 1);
  if (!(width >= kNarrowest)) {
    throw InputError(
        fmt::format("rough_dielectric: alpha * |ior - 1| must be at least {:g}, got "
                    "{:g}; dielectric is the limit",
                    kNarrowest, width));
  }
}

ScatterValue RoughDielectric::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                       ScatterOptions options) const {
  if (wo.z == 0 || wi.z == 0) return {};
  const Scattering s = scatter(point, turned(wo, wo), turned(wi, wo), eta_beyond(wo), options);
  return {s.pdf * s.weight, s.pdf};
}

std::optional<ScatterSample> RoughDielectric::sample(const SurfacePoint& point, Vec3 wo,
                                                     float u_choice, Vec2 u,
                                                     ScatterOptions options) const {
  if (wo.z == 0) return {};
  const float eta = eta_beyond(wo);
  const Vec3 above = turned(wo, wo);
  const Vec3 m = facets_.sample_visible_normal(above, u);
  const float cosine = std::clamp(dot(above, m), 0.0f, 1.0f);
  const float fresnel = dielectric_fresnel(cosine, eta).reflectance;
  const bool reflects = u_choice < reflect_probability(fresnel, options.events);
  if (!reflects && fresnel == 1) return {};  // total reflection is not allowed
  const std::optional<Vec3> wi = facet_direction(above, m, eta, reflects);
  if (!wi) return {};
  const Scattering s = scatter(point, above, *wi, eta, options);
  if (s.pdf == 0) return {};
  return ScatterSample{turned(*wi, wo), reflects ? Event::smooth_reflect : Event::smooth_transmit,
                       s.weight, s.pdf};
}

RoughDielectric::Scattering RoughDielectric::scatter(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                                     float eta, ScatterOptions options) const {
  return wi.z > 0 ? reflect(point, wo, wi, eta, options.events)
                  : refract(point, wo, wi, eta, options);
}

RoughDielectric::Scattering RoughDielectric::reflect(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                                     float eta, EventMask events) const {
  const std::optional<Vec3> m = half_vector(wo, wi);
  if (!m) return {};
  const float fresnel = dielectric_fresnel(std::min(1.0f, dot(wo, *m)), eta).reflectance;
  const float probability = reflect_probability(fresnel, events);
  if (probability == 0) return {};
  const auto [shadowing, pdf] = facets_.mirrored(wo, wi, *m, settings_.masking);
  const float share = fresnel / probability * shadowing;
  return {share * settings_.specular_reflectance->evaluate(point), probability * pdf};
}

RoughDielectric::Scattering RoughDielectric::refract(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                                     float eta, ScatterOptions options) const {
  const std::optional<RefractingFacet> facet = refracting_facet(wo, wi, eta);
  if (!facet) return {};
  const float probability = refract_probability(facet->fresnel, options.events);
  if (probability == 0) return {};
  const float scale = options.transport == Transport::radiance ? 1 / (eta * eta) : 1;
  const auto [shadowing, pdf] = facets_.by_normal(wo, wi, facet->normal, settings_.masking);
  const float share = (1 - facet->fresnel) / probability * shadowing;
  return {scale * share * settings_.specular_transmittance->evaluate(point),
          probability * pdf * facet->jacobian};
}

Rgb RoughDielectric::albedo(const SurfacePoint& point) const {
  return average_fresnel_ * settings_.specular_reflectance->evaluate(point) +
         (1 - average_fresnel_) * settings_.specular_transmittance->evaluate(point);
}

}  // namespace pharos
