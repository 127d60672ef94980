// blend: two materials mixed, (1 - weight) first + weight second, as for dust on a floor or rust on
// metal. Blends may be blended. A surface bounds two media of one ratio of refractive indices, and
// a path knows a refraction by its event alone; so where both let light through by refraction,
// their indices must be the same.
//
// Beware of blends of `dielectric` or `rough_dielectric` with `diffuse_transmitter`: refraction
// scales radiance by the square of the index, so that where all is in equilibrium there is ior^2
// times as much inside as outside; diffuse transmission does not, and asks for as much on either
// side. Such a blend conserves the light of each event, yet what goes in by one and out by the
// other is gained or lost; a furnace sees it. Give the paper its own surface instead.
//
//     type: blend
//     first: { type: plastic, reflectance: 0.2 }
//     second: { type: diffuse, reflectance: 0.6 }
//     weight: { type: bitmap, file: dust.png, color_space: linear }
#include "blend.h"

#include <fmt/core.h>

#include <pharos/config/registry.h>

#include "parameters.h"

namespace pharos {
namespace {

/// Whether both let light through by refraction, and do so differently.
bool refract_differently(const Bsdf& a, const Bsdf& b) {
  // An interface of index one refracts too, straight on, but only a smooth one may have it.
  const auto refracts = [](const Bsdf& bsdf) {
    return bsdf.relative_ior() != 1 || contains(bsdf.events(), Event::discrete_transmit);
  };
  return refracts(a) && refracts(b) && a.relative_ior() != b.relative_ior();
}

}  // namespace

void Blend::Settings::describe(Schema<Settings>& s) {
  s.field("first", &Settings::first, "Material where the weight is 0").required();
  s.field("second", &Settings::second, "Material where the weight is 1").required();
  describe_share(s, "weight", &Settings::weight, "Share of the second", "0.5");
  s.example("{ first: { type: diffuse }, second: { type: rough_conductor, alpha: 0.3 } }");
  s.example("{ first: { type: plastic }, second: { type: diffuse }, weight: [0.2, 0.5, 0.8] }");
  s.example(
      "{ first: { type: dielectric }, second: { type: rough_dielectric, alpha: 0.3 }, weight: 0.3 "
      "}");
  s.example(
      "{ first: { type: plastic, ior: 1.9 }, weight: 0.4, "
      "second: { type: blend, first: { type: plastic }, second: { type: mask } } }");
}

Blend::Blend(const Settings& settings)
    : MixedBsdf(settings.first, settings.second, settings.weight) {
  if (!refract_differently(*settings.first, *settings.second)) return;
  throw InputError(fmt::format(
      "'first' and 'second' must refract alike, but their refractive indices inside over outside "
      "are {:.4g} and {:.4g}",
      1 / settings.first->relative_ior(), 1 / settings.second->relative_ior()));
}

}  // namespace pharos
