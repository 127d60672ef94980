// diffuse_transmitter: thin paper, cloth or a leaf, lit from either side. Light is scattered by
// Lambert's cosine law, transmittance / pi on the side it did not come from and reflectance / pi on
// the side it came from. Both sides are alike. sample() chooses between them by the mean of the
// channels.
//
// The two must not add up to more than 1. Of uniform colours that is tested in each channel; of a
// texture that varies only its largest value is known, which stands for all channels and places.
//
//     { type: diffuse_transmitter, transmittance: [0.2, 0.4, 0.05], reflectance: 0.3 }
#include "diffuse_transmitter.h"

#include <cmath>

#include <fmt/core.h>

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

namespace pharos {
namespace {

/// A bound of `texture` in each channel: its colour if it is uniform, as far as probes can tell,
/// and else its largest value.
Rgb upper_bound(const Texture& texture) {
  const Rgb average = texture.average();
  constexpr int kProbes = 64;
  for (int i = 0; i < kProbes; ++i) {
    // Points that fill the square evenly (Roberts 2018, "The Unreasonable Effectiveness of
    // Quasirandom Sequences").
    const float x = 0.7548777f * static_cast<float>(i), y = 0.5698403f * static_cast<float>(i);
    SurfacePoint point;
    point.uv = {x - std::floor(x), y - std::floor(y)};
    point.position = {point.uv.x, point.uv.y, 0};
    if (texture.evaluate(point) != average) return Rgb(texture.maximum());
  }
  return average;
}

}  // namespace

void DiffuseTransmitter::Settings::describe(Schema<Settings>& s) {
  s.field("transmittance", &Settings::transmittance, "Share of light that is let through")
      .otherwise("0.5")
      .check("at most 1 everywhere", [](const Ref<Texture>& t) { return t->maximum() <= 1; });
  s.field("reflectance", &Settings::reflectance, "Share of light that is reflected")
      .otherwise("0")
      .check("at most 1 everywhere", [](const Ref<Texture>& t) { return t->maximum() <= 1; });
  s.example("{ transmittance: 0.3, reflectance: 0.7 }");
  s.example("{ transmittance: [0.1, 0.6, 0.2], reflectance: [0.3, 0.3, 0.05] }");
}

DiffuseTransmitter::DiffuseTransmitter(const Settings& settings) : settings_(settings) {
  const Rgb transmitted = upper_bound(*settings.transmittance);
  const Rgb reflected = upper_bound(*settings.reflectance);
  for (int c = 0; c < 3; ++c) {
    if (transmitted[c] + reflected[c] <= 1) continue;
    throw InputError(
        fmt::format("transmittance and reflectance must not add up to more than 1, but their "
                    "largest values are {:.4g} and {:.4g}",
                    transmitted[c], reflected[c]));
  }
}

EventMask DiffuseTransmitter::events() const {
  EventMask all = EventMask::nothing;
  if (settings_.reflectance->maximum() > 0) all = all | mask_of(Event::smooth_reflect);
  if (settings_.transmittance->maximum() > 0) all = all | mask_of(Event::smooth_transmit);
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
  const float density = warp::cosine_hemisphere_pdf(std::abs(wi.z));
  return {density * (same_side ? reflectance : transmittance),
          density * (same_side ? choice.first() : choice.second())};
}

std::optional<ScatterSample> DiffuseTransmitter::sample(const SurfacePoint& point, Vec3 wo,
                                                        float u_choice, Vec2 u,
                                                        ScatterOptions options) const {
  const auto [reflectance, transmittance, choice] = lobes(point, options.events);
  Vec3 wi = warp::cosine_hemisphere_from_square(u);
  if (choice.nothing() || wo.z == 0 || wi.z == 0) return {};
  const float density = warp::cosine_hemisphere_pdf(wi.z);
  const bool reflects = choice.takes_first(u_choice);
  if (reflects != (wo.z > 0)) wi.z = -wi.z;
  if (reflects) {
    return ScatterSample{wi, Event::smooth_reflect, reflectance / choice.first(),
                         density * choice.first()};
  }
  return ScatterSample{wi, Event::smooth_transmit, transmittance / choice.second(),
                       density * choice.second()};
}

Rgb DiffuseTransmitter::albedo(const SurfacePoint& point) const {
  return settings_.reflectance->evaluate(point) + settings_.transmittance->evaluate(point);
}

}  // namespace pharos
