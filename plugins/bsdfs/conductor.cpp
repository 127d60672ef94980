// conductor: a polished metal. It is a mirror whose reflectance F follows Fresnel's equations for a
// complex index eta - i k in each color channel (relative to vacuum). `material` names a measured
// metal (metals.cpp gives the sources) or `ideal`, which reflects everything. Any other metal is
// given by `eta` and `k` instead. Only the side of the shading normal reflects light; the other
// side is black.
//
//     { type: conductor, material: Ag }
//     { type: conductor, eta: [1.66, 0.88, 0.52], k: [9.2, 6.27, 4.84] }
#include "conductor.h"

#include "discrete_choice.h"
#include "fresnel.h"
#include "parameters.h"

namespace pharos {

void Conductor::Settings::describe(Schema<Settings>& s) {
  describe_metal(s);
  describe_factor(s, "specular_reflectance", &Settings::specular_reflectance,
                  "Factor on what is reflected");
  s.example("{ material: Au }");
  s.example("{ eta: [1.66, 0.88, 0.52], k: [9.2, 6.27, 4.84], specular_reflectance: 0.8 }");
}

Conductor::Conductor(const Settings& settings)
    : ior_(stated_ior(settings.material, settings.eta, settings.k)),
      specular_reflectance_(settings.specular_reflectance),
      average_fresnel_(average_conductor_fresnel(ior_)) {}

DiscreteOutcomes Conductor::discrete(const SurfacePoint& point, Vec3 wo,
                                     ScatterOptions options) const {
  DiscreteOutcomes outcomes;
  if (wo.z <= 0 || !contains(options.events, Event::discrete_reflect)) return outcomes;
  const Rgb fresnel = conductor_fresnel(std::min(1.0f, wo.z), ior_.eta, ior_.k);
  outcomes.add({Event::discrete_reflect,
                {-wo.x, -wo.y, wo.z},
                fresnel * specular_reflectance_->evaluate(point),
                1});
  return outcomes;
}

std::optional<ScatterSample> Conductor::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                               Vec2, ScatterOptions options) const {
  return draw_outcome(discrete(point, wo, options), u_choice);
}

Rgb Conductor::albedo(const SurfacePoint& point) const {
  return average_fresnel_ * specular_reflectance_->evaluate(point);
}

}  // namespace pharos
