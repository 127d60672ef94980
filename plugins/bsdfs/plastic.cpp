// plastic: a matt base under a smooth clear coat, for plastics, varnish and glazed china. The coat
// mirrors the share F given by Fresnel's equations (a discrete event). The light that enters is
// scattered by the base and by reflections between base and coat (a smooth event):
//
//     f = (1 - F(o)) (1 - F(i)) / (pi eta^2)  a / (1 - a F'),
//
// where F' is the mean reflectance of the coat's inner side, so that a white base reflects all
// light (see diffuse_base.h). If `nonlinear` is false, the a in the denominator is replaced by 1:
// repeated reflection then does not make colors more saturated. sample() chooses between coat and
// base in proportion to the mean of the channels of the light they reflect. Only the side of the
// normal scatters light.
//
//     { type: plastic, ior: 1.5, reflectance: [0.1, 0.3, 0.7], nonlinear: true }
#include "plastic.h"

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

#include "fresnel.h"
#include "hemisphere_mean.h"
#include "parameters.h"

namespace pharos {

void Plastic::Settings::describe(Schema<Settings>& s) {
  describe_coat_ior(s);
  describe_share(s, "reflectance", &Settings::reflectance, "Share of light that the base reflects",
                 "0.5");
  describe_factor(s, "specular_reflectance", &Settings::specular_reflectance,
                  "Factor on what the coat reflects");
  s.field("nonlinear", &Settings::nonlinear,
          "Whether repeated reflection below the coat deepens the color");
  s.example("{ reflectance: 1, nonlinear: true }");
  s.example("{ ior: 1.9, reflectance: [0.8, 0.4, 0.05], nonlinear: true }");
  s.example("{ ior: 1.3, reflectance: [0.1, 0.2, 0.9], specular_reflectance: 0.5 }");
}

Plastic::Plastic(const Settings& settings)
    : settings_(settings),
      base_(hemisphere_mean([this](float cosine) { return 1 - coat(cosine); }), settings.ior,
            settings.nonlinear) {}

float Plastic::coat(float cosine) const {
  return dielectric_fresnel(std::min(1.0f, cosine), settings_.ior).reflectance;
}

Plastic::Layers Plastic::layers(const SurfacePoint& point, float cosine, EventMask allowed) const {
  const auto value = [&](Event event, const Texture& texture) {
    return contains(allowed, event) ? texture.evaluate(point) : Rgb();
  };
  const float reflected = coat(cosine), entering = 1 - reflected;
  const Rgb mirrored = reflected * value(Event::discrete_reflect, *settings_.specular_reflectance);
  const Rgb emerging = base_.emerging(value(Event::smooth_reflect, *settings_.reflectance));
  return {mirrored, emerging, entering, {mean(mirrored), entering * mean(emerging)}};
}

ScatterValue Plastic::scattered(const Layers& layers, Vec3 wi) const {
  if (wi.z <= 0) return {};
  const float density = warp::cosine_hemisphere_pdf(wi.z);
  return {density * base_.weight(layers.emerging, layers.entering, 1 - coat(wi.z)),
          density * layers.choice.second()};
}

ScatterValue Plastic::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                               ScatterOptions options) const {
  if (wo.z <= 0 || wi.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  return scattered(layers(point, wo.z, options.events), wi);
}

std::optional<ScatterSample> Plastic::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                             Vec2 u, ScatterOptions options) const {
  if (wo.z <= 0) return {};
  const Layers all = layers(point, wo.z, options.events);
  if (all.choice.nothing()) return {};
  if (all.choice.takes_first(u_choice)) {
    const float probability = all.choice.first();
    return ScatterSample{
        {-wo.x, -wo.y, wo.z}, Event::discrete_reflect, all.mirrored / probability, probability};
  }
  const Vec3 wi = warp::cosine_hemisphere_from_square(u);
  const ScatterValue value = scattered(all, wi);
  if (value.pdf == 0) return {};
  return ScatterSample{wi, Event::smooth_reflect, value.value / value.pdf, value.pdf};
}

DiscreteOutcomes Plastic::discrete(const SurfacePoint& point, Vec3 wo,
                                   ScatterOptions options) const {
  DiscreteOutcomes outcomes;
  if (wo.z <= 0) return outcomes;
  const Layers all = layers(point, wo.z, options.events);
  const float probability = all.choice.first();
  if (probability == 0) return outcomes;
  outcomes.add({Event::discrete_reflect, {-wo.x, -wo.y, wo.z}, all.mirrored, probability});
  return outcomes;
}

Rgb Plastic::albedo(const SurfacePoint& point) const {
  return base_.albedo(settings_.reflectance->evaluate(point),
                      settings_.specular_reflectance->evaluate(point));
}

}  // namespace pharos
