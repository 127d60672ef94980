// blend: two materials mixed, (1 - weight) first + weight second, as for dust on a floor or rust on
// metal. Blends may be blended. A surface bounds two media of one ratio of refractive indices, and
// a path knows a refraction by its event alone; so where both let light through by refraction,
// their indices must be the same.
//
//     type: blend
//     first: { type: plastic, reflectance: 0.2 }
//     second: { type: diffuse, reflectance: 0.6 }
//     weight: { type: bitmap, file: dust.png, color_space: linear }
#include "blend.h"

#include <fmt/core.h>

#include <pharos/config/registry.h>

namespace pharos {
namespace {

/// Whether both can bend light's way through, and do so differently.
bool refract_differently(const Bsdf& a, const Bsdf& b) {
  if (a.relative_ior() == b.relative_ior()) return false;
  const auto bends = [](const Bsdf& bsdf) { return bsdf.relative_ior() != 1; };
  const auto refracts = [](const Bsdf& bsdf) {
    return contains(bsdf.events(), Event::discrete_transmit);
  };
  return (bends(a) && bends(b)) || (refracts(a) && refracts(b));
}

}  // namespace

void Blend::Settings::describe(Schema<Settings>& s) {
  s.field("first", &Settings::first, "Material where the weight is 0").required();
  s.field("second", &Settings::second, "Material where the weight is 1").required();
  s.field("weight", &Settings::weight, "Share of the second")
      .otherwise("0.5")
      .check("at most 1 everywhere", [](const Ref<Texture>& t) { return t->maximum() <= 1; });
  s.example("{ first: { type: diffuse }, second: { type: rough_conductor, alpha: 0.3 } }");
  s.example("{ first: { type: plastic }, second: { type: diffuse }, weight: [0.2, 0.5, 0.8] }");
  s.example("{ first: { type: dielectric }, second: { type: diffuse_transmitter }, weight: 0.3 }");
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
