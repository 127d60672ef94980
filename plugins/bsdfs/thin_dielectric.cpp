// thin_dielectric: a clear pane so thin that both of its faces are one surface, such as a window or
// a soap film, the same medium on either side. With F by Fresnel's equations at each face, light
// goes to and fro between them; the sum over all ways is
//
//     reflected  F + (1 - F)^2 F (1 + F^2 + F^4 + ...) = 2 F / (1 + F),
//     transmitted   (1 - F)^2   (1 + F^2 + F^4 + ...) = (1 - F) / (1 + F)
//
// (Stokes 1862 for piles of plates; without interference). What is transmitted goes straight on,
// undisplaced: the event is `pass_through`, with which shading normals have nothing to do.
//
//     { type: thin_dielectric, ior: 1.5, specular_transmittance: [0.9, 1, 0.95] }
#include "thin_dielectric.h"

#include "fresnel.h"
#include "hemisphere_mean.h"
#include "parameters.h"

namespace pharos {
namespace {

/// The share [1] that a pane reflects at `cosine` to its normal, in [0, 1].
float pane_reflectance(float cosine, float ior) {
  const float fresnel = dielectric_fresnel(cosine, ior).reflectance;
  return 2 * fresnel / (1 + fresnel);
}

}  // namespace

void ThinDielectric::Settings::describe(Schema<Settings>& s) {
  describe_ior(s, "Refractive index of the pane over its surroundings");
  describe_both_factors(s, "transmitted");
  s.example("{ ior: 0.75 }");
  s.example("{ ior: 1.33, specular_reflectance: 0.9, specular_transmittance: [0.2, 0.7, 1] }");
}

ThinDielectric::ThinDielectric(const Settings& settings)
    : SmoothInterface(
          settings.specular_reflectance, settings.specular_transmittance,
          hemisphere_mean([&](float cosine) { return pane_reflectance(cosine, settings.ior); })),
      ior_(settings.ior) {}

DiscreteOutcomes ThinDielectric::discrete(const SurfacePoint& point, Vec3 wo,
                                          ScatterOptions options) const {
  if (wo.z == 0) return {};
  const float reflected = pane_reflectance(std::min(1.0f, std::abs(wo.z)), ior_);
  return split(point, wo, reflected, {Event::pass_through, -wo}, options.events);
}

}  // namespace pharos
