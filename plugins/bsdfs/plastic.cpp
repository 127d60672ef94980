// plastic: a matt base under a smooth clear coat, as plastics, varnish and glazed china have it.
// The coat mirrors the share F of Fresnel's equations (a discrete event); what enters is scattered
// by the base and by reflections between base and coat (smooth),
//
//     f = (1 - F(o)) (1 - F(i)) / (pi eta^2)  a / (1 - a F'),
//
// with F' the mean reflectance of the coat's inner side, so that a white base reflects all light
// (see diffuse_base.h). With `nonlinear: false` the a below the line is 1: colours do not get more
// saturated by repeated reflection. sample() chooses coat and base in proportion to the mean
// of the channels of what they reflect. Light is scattered on the side of the normal only.
//
//     { type: plastic, ior: 1.5, reflectance: [0.1, 0.3, 0.7], nonlinear: true }
#include "plastic.h"

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

#include "fresnel.h"
#include "specular_factor.h"

namespace pharos {

void Plastic::Settings::describe(Schema<Settings>& s) {
  s.field("ior", &Settings::ior, "Refractive index of the coat over that outside").at_least(1);
  s.field("reflectance", &Settings::reflectance, "Share of light that the base reflects")
      .otherwise("0.5")
      .check("at most 1 everywhere", [](const Ref<Texture>& t) { return t->maximum() <= 1; });
  describe_factor(s, "specular_reflectance", &Settings::specular_reflectance,
                  "Factor on what the coat reflects");
  s.field("nonlinear", &Settings::nonlinear, "Whether repeated reflection deepens the colour");
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

LobeChoice Plastic::lobes(const SurfacePoint& point, float cosine, EventMask allowed) const {
  const float reflected = coat(cosine);
  const bool mirrors = contains(allowed, Event::discrete_reflect);
  const bool scatters = contains(allowed, Event::smooth_reflect);
  return {mirrors ? reflected * mean(settings_.specular_reflectance->evaluate(point)) : 0,
          scatters ? (1 - reflected) * mean(base_.emerging(settings_.reflectance->evaluate(point)))
                   : 0};
}

ScatterValue Plastic::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                               ScatterOptions options) const {
  if (wo.z <= 0 || wi.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const float density = warp::cosine_hemisphere_pdf(wi.z);
  const Rgb weight =
      base_.weight(settings_.reflectance->evaluate(point), 1 - coat(wo.z), 1 - coat(wi.z));
  return {density * weight, density * lobes(point, wo.z, options.events).second()};
}

std::optional<ScatterSample> Plastic::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                             Vec2 u, ScatterOptions options) const {
  if (wo.z <= 0) return {};
  const LobeChoice choice = lobes(point, wo.z, options.events);
  if (choice.nothing()) return {};
  if (choice.takes_first(u_choice)) {
    const DiscreteOutcome mirrored = discrete(point, wo, options).outcomes[0];
    return ScatterSample{mirrored.direction, mirrored.event, mirrored.value / mirrored.probability,
                         mirrored.probability};
  }
  const Vec3 wi = warp::cosine_hemisphere_from_square(u);
  const ScatterValue scattered = evaluate(point, wo, wi, options);
  if (scattered.pdf == 0) return {};
  return ScatterSample{wi, Event::smooth_reflect, scattered.value / scattered.pdf, scattered.pdf};
}

DiscreteOutcomes Plastic::discrete(const SurfacePoint& point, Vec3 wo,
                                   ScatterOptions options) const {
  DiscreteOutcomes outcomes;
  if (wo.z <= 0) return outcomes;
  const float probability = lobes(point, wo.z, options.events).first();
  if (probability == 0) return outcomes;
  outcomes.add({Event::discrete_reflect,
                {-wo.x, -wo.y, wo.z},
                coat(wo.z) * settings_.specular_reflectance->evaluate(point),
                probability});
  return outcomes;
}

Rgb Plastic::albedo(const SurfacePoint& point) const {
  return base_.albedo(settings_.reflectance->evaluate(point),
                      settings_.specular_reflectance->evaluate(point));
}

}  // namespace pharos
