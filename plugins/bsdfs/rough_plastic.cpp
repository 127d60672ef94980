// rough_plastic: `plastic` with a rough coat, the sum of microfacets and a matt base,
//
//     f = F(o.m) D(m) G2(o, i) / (4 cos(o) cos(i))  +  T(o) T(i) / (pi eta^2)  a / (1 - a F'),
//
// where m is the unit half vector, T the coat's transmittance in one direction, and F' the mean
// reflectance of its inner side (see diffuse_base.h). T is the share of light that the first term
// does not reflect (rough_coat.h). So a white base reflects all light, up to the error of a table,
// which is below 0.001 for alpha >= 0.001. sample() chooses between coat and base in proportion to
// the mean of the channels of the light they reflect. `distribution` and `masking` have the same
// meaning as in rough_conductor. Only the side of the normal scatters light.
//
//     { type: rough_plastic, alpha: 0.15, reflectance: [0.1, 0.3, 0.7], nonlinear: true }
#include "rough_plastic.h"

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

#include "hemisphere_mean.h"
#include "parameters.h"

namespace pharos {

void RoughPlastic::Settings::describe(Schema<Settings>& s) {
  s.field("alpha", &Settings::alpha, "Roughness of the coat").at_least(1e-4).at_most(1);
  describe_facets(s);
  describe_coat_ior(s);
  describe_share(s, "reflectance", &Settings::reflectance, "Share of light that the base reflects",
                 "0.5");
  describe_factor(s, "specular_reflectance", &Settings::specular_reflectance,
                  "Factor on what the coat reflects");
  s.field("nonlinear", &Settings::nonlinear,
          "Whether repeated reflection below the coat deepens the color");
  s.example("{ alpha: 0.02, reflectance: 1, nonlinear: true }");
  s.example(
      "{ alpha: 0.4, distribution: beckmann, ior: 1.9, reflectance: [0.8, 0.4, 0.05], nonlinear: "
      "true }");
  s.example("{ alpha: 1, ior: 1.3, reflectance: [0.1, 0.2, 0.9], specular_reflectance: 0.5 }");
}

RoughPlastic::RoughPlastic(const Settings& settings)
    : settings_(settings),
      coat_(settings.distribution, settings.alpha, settings.ior, settings.masking),
      base_(hemisphere_mean([this](float cosine) { return coat_.transmittance(cosine); }),
            settings.ior, settings.nonlinear) {}

RoughPlastic::Layers RoughPlastic::layers(const SurfacePoint& point, float cosine) const {
  const Rgb specular = settings_.specular_reflectance->evaluate(point);
  const Rgb emerging = base_.emerging(settings_.reflectance->evaluate(point));
  const float entering = coat_.transmittance(cosine);
  return {
      specular, emerging, entering, {(1 - entering) * mean(specular), entering * mean(emerging)}};
}

ScatterValue RoughPlastic::scattered(const Layers& layers, Vec3 wo, Vec3 wi) const {
  if (wi.z <= 0) return {};
  const RoughCoat::Reflection mirrored = coat_.reflect(wo, wi);
  const float density = warp::cosine_hemisphere_pdf(wi.z);
  const Rgb base = base_.weight(layers.emerging, layers.entering, coat_.transmittance(wi.z));
  return {mirrored.pdf * mirrored.weight * layers.specular + density * base,
          mirrored.pdf * layers.choice.first() + density * layers.choice.second()};
}

ScatterValue RoughPlastic::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                    ScatterOptions options) const {
  if (wo.z <= 0 || wi.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  return scattered(layers(point, wo.z), wo, wi);
}

std::optional<ScatterSample> RoughPlastic::sample(const SurfacePoint& point, Vec3 wo,
                                                  float u_choice, Vec2 u,
                                                  ScatterOptions options) const {
  if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const Layers all = layers(point, wo.z);
  if (all.choice.nothing()) return {};
  const Vec3 wi = all.choice.takes_first(u_choice) ? coat_.sample(wo, u)
                                                   : warp::cosine_hemisphere_from_square(u);
  const ScatterValue value = scattered(all, wo, wi);
  if (value.pdf == 0) return {};
  return ScatterSample{wi, Event::smooth_reflect, value.value / value.pdf, value.pdf};
}

Rgb RoughPlastic::albedo(const SurfacePoint& point) const {
  return base_.albedo(settings_.reflectance->evaluate(point),
                      settings_.specular_reflectance->evaluate(point));
}

}  // namespace pharos
