// diffuse_transmitter: thin paper, cloth or a leaf, lit from either side. Light is scattered by
// Lambert's cosine law: transmittance / pi to the far side, and reflectance / pi back to the side
// of the incident light. Both sides are alike. sample() chooses between them in proportion to the
// mean of the channels. `warp` has the same meaning as for `diffuse`.
//
// Transmittance and reflectance must not add up to more than 1. For a texture that varies, only the
// largest value of each channel is known, and the check uses this value for the whole surface.
//
//     { type: diffuse_transmitter, transmittance: [0.2, 0.4, 0.05], reflectance: 0.3 }
#include "diffuse_transmitter.h"

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

#include "parameters.h"

namespace pharos {

void DiffuseTransmitter::Settings::describe(Schema<Settings>& s) {
  describe_share(s, "transmittance", &Settings::transmittance, "Share of light that is transmitted",
                 "0.5");
  describe_share(s, "reflectance", &Settings::reflectance, "Share of light that is reflected", "0");
  describe_warp(s);
  s.example("{ transmittance: 0.3, reflectance: 0.7 }");
  s.example("{ transmittance: [0.1, 0.6, 0.2], reflectance: [0.3, 0.3, 0.05] }");
}

DiffuseTransmitter::DiffuseTransmitter(const Settings& settings) : settings_(settings) {
  check_sum(*settings.transmittance, *settings.reflectance, "transmittance and reflectance");
}

EventMask DiffuseTransmitter::events() const {
  EventMask all = EventMask::nothing;
  if (!is_black(settings_.reflectance->maximum())) all = all | mask_of(Event::smooth_reflect);
  if (!is_black(settings_.transmittance->maximum())) all = all | mask_of(Event::smooth_transmit);
  return all;
}

DiffuseTransmitter::Lobes DiffuseTransmitter::lobes(const SurfacePoint& point,
                                                    EventMask allowed) const {
  const auto lobe = [&](Event event, const Texture& texture) {
    return contains(allowed, event) ? texture.evaluate(point) : Rgb();
  };
  const Rgb reflectance = lobe(Event::smooth_reflect, *settings_.reflectance);
  const Rgb transmittance = lobe(Event::smooth_transmit, *settings_.transmittance);
  return {reflectance, transmittance, {mean(reflectance), mean(transmittance)}};
}

ScatterValue DiffuseTransmitter::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                          ScatterOptions options) const {
  if (wo.z == 0 || wi.z == 0) return {};
  const auto [reflectance, transmittance, choice] = lobes(point, options.events);
  const bool same_side = (wo.z > 0) == (wi.z > 0);
  const float density = hemisphere_pdf(settings_.warp, {wi.x, wi.y, std::abs(wi.z)});
  return {warp::cosine_hemisphere_pdf(std::abs(wi.z)) * (same_side ? reflectance : transmittance),
          density * (same_side ? choice.first() : choice.second())};
}

std::optional<ScatterSample> DiffuseTransmitter::sample(const SurfacePoint& point, Vec3 wo,
                                                        float u_choice, Vec2 u,
                                                        ScatterOptions options) const {
  const auto [reflectance, transmittance, choice] = lobes(point, options.events);
  Vec3 wi = hemisphere_from_square(settings_.warp, u);
  if (choice.nothing() || wo.z == 0 || wi.z == 0) return {};
  const float density = hemisphere_pdf(settings_.warp, wi);
  const float weight = warp::cosine_hemisphere_pdf(wi.z) / density;
  const bool reflects = choice.takes_first(u_choice);
  if (reflects != (wo.z > 0)) wi.z = -wi.z;
  if (reflects) {
    return ScatterSample{wi, Event::smooth_reflect, (weight / choice.first()) * reflectance,
                         density * choice.first()};
  }
  return ScatterSample{wi, Event::smooth_transmit, (weight / choice.second()) * transmittance,
                       density * choice.second()};
}

Rgb DiffuseTransmitter::albedo(const SurfacePoint& point) const {
  return settings_.reflectance->evaluate(point) + settings_.transmittance->evaluate(point);
}

}  // namespace pharos
