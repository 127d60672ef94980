// two_sided: gives an opaque material, which scatters only on the side of the normal, a second
// side. The back behaves like the front of `back` (or of `bsdf`, if `back` is not given) in a
// shading frame mirrored at the surface: z changes its sign, x and y stay. For a material with
// holes, put the mask outside, around two_sided.
//
//     { type: two_sided, bsdf: { type: plastic, reflectance: 0.8 }, back: { type: diffuse } }
#include "two_sided.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <pharos/config/registry.h>

namespace pharos {
namespace {

Vec3 mirrored(Vec3 v) {
  return {v.x, v.y, -v.z};
}

void check_opaque(const Bsdf& bsdf, const char* key) {
  if (is_empty(bsdf.events() & EventMask::transmit)) return;
  const std::string& name = bsdf.plugin_name();
  throw InputError(fmt::format("{} must be opaque, but {} lets light through", key,
                               name.empty() ? "it" : fmt::format("'{}'", name)));
}

}  // namespace

void TwoSided::Settings::describe(Schema<Settings>& s) {
  s.field("bsdf", &Settings::bsdf, "Opaque material of the front, the side of the normal")
      .otherwise("{ type: diffuse }");
  s.field("back", &Settings::back,
          "Opaque material of the back; by default the material of the front");
  s.example("{ bsdf: { type: plastic, ior: 1.7 } }");
  s.example("{ bsdf: { type: rough_conductor, alpha: 0.3 }, back: { type: rough_plastic } }");
}

TwoSided::TwoSided(const Settings& settings)
    : front_(settings.bsdf), back_(settings.back != nullptr ? settings.back : settings.bsdf) {
  check_opaque(*front_, "bsdf");
  check_opaque(*back_, "back");
}

ScatterValue TwoSided::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                ScatterOptions options) const {
  if (wo.z >= 0) return front_->evaluate(point, wo, wi, options);
  return back_->evaluate(point, mirrored(wo), mirrored(wi), options);
}

std::optional<ScatterSample> TwoSided::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                              Vec2 u, ScatterOptions options) const {
  if (wo.z >= 0) return front_->sample(point, wo, u_choice, u, options);
  auto result = back_->sample(point, mirrored(wo), u_choice, u, options);
  if (result) result->direction = mirrored(result->direction);
  return result;
}

DiscreteOutcomes TwoSided::discrete(const SurfacePoint& point, Vec3 wo,
                                    ScatterOptions options) const {
  if (wo.z >= 0) return front_->discrete(point, wo, options);
  DiscreteOutcomes all;
  for (DiscreteOutcome outcome : back_->discrete(point, mirrored(wo), options)) {
    outcome.direction = mirrored(outcome.direction);
    all.add(outcome);
  }
  return all;
}

float TwoSided::roughness(const SurfacePoint& point) const {
  return std::min(front_->roughness(point), back_->roughness(point));
}

}  // namespace pharos
