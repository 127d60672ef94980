// thin_dielectric: a clear pane, such as a window or a soap film, so thin that both of its faces
// are one surface. The medium is the same on both sides. Each face reflects the share F given by
// Fresnel's equations, and light goes to and fro between the faces. The sum over all numbers of
// reflections is
//
//     reflected     F + (1 - F)^2 F (1 + F^2 + F^4 + ...) = 2 F / (1 + F),
//     transmitted       (1 - F)^2   (1 + F^2 + F^4 + ...) = (1 - F) / (1 + F)
//
// (Stokes 1862 for piles of plates; without interference). Transmitted light goes straight on,
// without displacement. Its event is `pass_through`, which does not depend on shading normals.
//
//     { type: thin_dielectric, ior: 1.5, specular_transmittance: [0.9, 1, 0.95] }
#include "thin_dielectric.h"

#include "fresnel.h"
#include "hemisphere_mean.h"
#include "parameters.h"

namespace pharos {
namespace {

/// The share [1] of light that a pane reflects at `cosine` to its normal, in [0, 1].
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
