// blend: a mix of two materials, (1 - weight) first + weight second, for example dust on a floor or
// rust on metal. Blends may be nested. A surface separates two media with a single ratio of
// refractive indices, and a path records a refraction only by its event. If both materials refract,
// their indices must therefore be equal.
//
// Avoid blends of `dielectric` or `rough_dielectric` with `diffuse_transmitter`. Refraction scales
// radiance by the square of the index, so in equilibrium radiance inside is ior^2 times the
// radiance outside. Diffuse transmission has no such factor and requires equal radiance on both
// sides. Such a blend conserves energy in each event, but light that enters by one event and leaves
// by the other gains or loses energy, as a furnace test shows. Give the paper a surface of its own
// instead.
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

/// Returns whether both materials refract and do so differently.
bool refract_differently(const Bsdf& a, const Bsdf& b) {
  // An interface of index one also refracts, straight on, but only a smooth interface may have this
  // index.
  const auto refracts = [](const Bsdf& bsdf) {
    return bsdf.relative_ior() != 1 || contains(bsdf.events(), Event::discrete_transmit);
  };
  return refracts(a) && refracts(b) && a.relative_ior() != b.relative_ior();
}

}  // namespace

void Blend::Settings::describe(Schema<Settings>& s) {
  s.field("first", &Settings::first, "Material where the weight is 0").required();
  s.field("second", &Settings::second, "Material where the weight is 1").required();
  describe_share(s, "weight", &Settings::weight, "Share of the second material", "0.5");
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
