// mask: a material with holes, such as lace, or leaves cut out of a rectangle. The share
// (1 - opacity) of light passes straight through, as if nothing were there (the event
// `pass_through`). The rest meets the nested material. A colored opacity filters the light that
// passes. Paths that go through a hole find the light behind it; light samples do not, because for
// them the surface is closed everywhere. Holes in glass upset the balance of energy: light that
// enters through a hole is inside without having been refracted.
//
//     type: mask
//     opacity: { type: bitmap, file: leaf_alpha.png, color_space: linear }
//     bsdf: { type: two_sided, bsdf: { type: diffuse, reflectance: [0.1, 0.4, 0.05] } }
#include "mask.h"

#include <pharos/config/registry.h>

#include "parameters.h"
#include "pass_through.h"

namespace pharos {

void Mask::Settings::describe(Schema<Settings>& s) {
  s.field("bsdf", &Settings::bsdf, "Material of the opaque parts").otherwise("{ type: diffuse }");
  describe_share(s, "opacity", &Settings::opacity, "Share of light that meets the material", "0.5");
  s.example("{ opacity: [0.3, 0.6, 0.9], bsdf: { type: rough_conductor, alpha: 0.3 } }");
  s.example("{ opacity: 0.8, bsdf: { type: dielectric, ior: 1.3 } }");
  s.example("{ opacity: 0.7, bsdf: { type: mask, opacity: 0.4, bsdf: { type: plastic } } }");
}

Mask::Mask(const Settings& settings)
    : MixedBsdf(std::make_shared<PassThrough>(), settings.bsdf, settings.opacity) {}

}  // namespace pharos
