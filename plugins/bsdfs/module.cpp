#include <pharos/config/module.h>

#include "blend.h"
#include "bump_map.h"
#include "conductor.h"
#include "dielectric.h"
#include "diffuse.h"
#include "diffuse_transmitter.h"
#include "mask.h"
#include "normal_map.h"
#include "pass_through.h"
#include "phong.h"
#include "plastic.h"
#include "principled.h"
#include "rough_conductor.h"
#include "rough_dielectric.h"
#include "rough_diffuse.h"
#include "rough_plastic.h"
#include "thin_dielectric.h"
#include "two_sided.h"
#include "ward.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::Diffuse>(
      "diffuse", "Matt surface that follows Lambert's cosine law, on the side of the normal");
  registry.add<pharos::RoughDiffuse>("rough_diffuse",
                                     "Rough matt surface of V-shaped grooves by Oren and Nayar");
  registry.add<pharos::Conductor>("conductor", "A polished metal");
  registry.add<pharos::RoughConductor>("rough_conductor",
                                       "Rough metal with GGX or Beckmann microfacets");
  registry.add<pharos::Dielectric>("dielectric", "Smooth glass: mirror reflection and refraction");
  registry.add<pharos::RoughDielectric>("rough_dielectric",
                                        "Rough glass with GGX or Beckmann microfacets");
  registry.add<pharos::ThinDielectric>("thin_dielectric", "Clear pane without thickness");
  registry.add<pharos::Plastic>("plastic", "A matt base under a smooth clear coat");
  registry.add<pharos::RoughPlastic>("rough_plastic", "A matt base under a rough clear coat");
  registry.add<pharos::Phong>("phong",
                              "A matt surface with a glossy lobe about the mirror direction");
  registry.add<pharos::Ward>("ward", "Ward's glossy lobe above a matt base");
  registry.add<pharos::Principled>("principled", "Disney's principled material, opaque or clear");
  registry.add<pharos::DiffuseTransmitter>("diffuse_transmitter",
                                           "Paper and leaves: Lambert's cosine law on both sides");
  registry.add<pharos::TwoSided>("two_sided", "An opaque material on both sides of a surface");
  registry.add<pharos::Mask>("mask", "A material with holes that light passes straight through");
  registry.add<pharos::PassThrough>("pass_through", "An invisible surface that bounds a medium");
  registry.add<pharos::Blend>("blend", "A mix of two materials");
  registry.add<pharos::BumpMap>("bump_map", "A material whose shading normal follows a height map");
  registry.add<pharos::NormalMap>("normal_map",
                                  "A material whose shading normal is read from a picture");
  registry.set_default<pharos::Bsdf>("diffuse");
}
