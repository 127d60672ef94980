// dielectric: the smooth interface of a clear medium. Light is mirrored with the share F of
// Fresnel's equations and refracted by Snell's law with 1 - F. Along paths from the sensor
// refracted values carry (n_o / n_i)^2, the invariance of radiance over n^2 (Veach 1997, eq. 5.13),
// so that going in and out again changes nothing. The normal points outside.
//
//     { type: dielectric, ior: 1.5 }
#include "dielectric.h"

#include "fresnel.h"

namespace pharos {

void Dielectric::Settings::describe(Schema<Settings>& s) {
  s.field("ior", &Settings::ior, "Refractive index inside over outside").above(0);
}

DiscreteOutcomes Dielectric::discrete(const SurfacePoint&, Vec3 wo, ScatterOptions options) const {
  DiscreteOutcomes outcomes;
  if (wo.z == 0) return outcomes;
  const float eta = wo.z > 0 ? ior_ : 1 / ior_;
  const DielectricFresnel fresnel = dielectric_fresnel(std::min(1.0f, std::abs(wo.z)), eta);
  const float reflected = fresnel.reflectance, transmitted = 1 - fresnel.reflectance;
  const bool reflects = reflected > 0 && contains(options.events, Event::discrete_reflect);
  const bool transmits = transmitted > 0 && contains(options.events, Event::discrete_transmit);
  if (reflects) {
    outcomes.add(
        {Event::discrete_reflect, {-wo.x, -wo.y, wo.z}, Rgb(reflected), transmits ? reflected : 1});
  }
  if (transmits) {
    const Vec3 refracted{-wo.x / eta, -wo.y / eta, std::copysign(fresnel.cos_transmitted, -wo.z)};
    const float scale = options.transport == Transport::radiance ? 1 / (eta * eta) : 1;
    outcomes.add({Event::discrete_transmit, normalize(refracted), Rgb(scale * transmitted),
                  reflects ? transmitted : 1});
  }
  return outcomes;
}

std::optional<ScatterSample> Dielectric::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                                Vec2, ScatterOptions options) const {
  const DiscreteOutcomes all = discrete(point, wo, options);
  if (all.count == 0) return {};
  const bool first = all.count == 1 || u_choice < all.outcomes[0].probability;
  const DiscreteOutcome& chosen = all.outcomes[first ? 0 : 1];
  return ScatterSample{chosen.direction, chosen.event, chosen.value / chosen.probability,
                       chosen.probability};
}

}  // namespace pharos
