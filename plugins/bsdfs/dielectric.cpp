// dielectric: the smooth interface of a clear medium. The share F of light given by Fresnel's
// equations is mirrored, and 1 - F is refracted by Snell's law. Along paths from the sensor
// refracted values include the factor (n_o / n_i)^2, because radiance over n^2 is invariant (Veach
// 1997, eq. 5.13). Light that enters and leaves again is therefore unchanged. The normal points
// outside. The two factors tint the reflected and the refracted light; F alone determines the
// choice between them.
//
//     { type: dielectric, ior: 1.5, specular_transmittance: [0.9, 1, 0.95] }
#include "dielectric.h"

#include "fresnel.h"
#include "parameters.h"

namespace pharos {

void Dielectric::Settings::describe(Schema<Settings>& s) {
  describe_ior(s, "Refractive index inside over outside");
  describe_both_factors(s, "refracted");
  s.example("{ ior: 0.75 }");
  s.example("{ ior: 2.4, specular_reflectance: 0.9, specular_transmittance: [0.2, 0.7, 1] }");
}

Dielectric::Dielectric(const Settings& settings)
    : SmoothInterface(settings.specular_reflectance, settings.specular_transmittance,
                      average_dielectric_fresnel(settings.ior)),
      ior_(settings.ior) {}

DiscreteOutcomes Dielectric::discrete(const SurfacePoint& point, Vec3 wo,
                                      ScatterOptions options) const {
  if (wo.z == 0) return {};
  const float eta = wo.z > 0 ? ior_ : 1 / ior_;
  const DielectricFresnel fresnel = dielectric_fresnel(std::min(1.0f, std::abs(wo.z)), eta);
  const Vec3 refracted{-wo.x / eta, -wo.y / eta, std::copysign(fresnel.cos_transmitted, -wo.z)};
  const float scale = options.transport == Transport::radiance ? 1 / (eta * eta) : 1;
  return split(point, wo, fresnel.reflectance,
               {Event::discrete_transmit, normalize(refracted), scale}, options.events);
}

}  // namespace pharos
