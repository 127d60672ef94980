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
  registry.add<pharos::Diffuse>("diffuse", "Lambert's cosine law on the outer side");
  registry.add<pharos::RoughDiffuse>("rough_diffuse", "Oren and Nayar's grooves of matt facets");
  registry.add<pharos::Conductor>("conductor", "Mirror of a polished metal");
  registry.add<pharos::RoughConductor>("rough_conductor", "GGX or Beckmann microfacets of a metal");
  registry.add<pharos::Dielectric>("dielectric", "Smooth glass: mirror reflection and refraction");
  registry.add<pharos::RoughDielectric>("rough_dielectric",
                                        "GGX or Beckmann microfacets of a clear medium");
  registry.add<pharos::ThinDielectric>("thin_dielectric", "Clear pane without thickness");
  registry.add<pharos::Plastic>("plastic", "A matt base under a smooth clear coat");
  registry.add<pharos::RoughPlastic>("rough_plastic", "A matt base under a rough clear coat");
  registry.add<pharos::Phong>("phong", "A matt surface with a lobe about the mirror direction");
  registry.add<pharos::Ward>("ward", "Ward's glossy lobe above a matt base");
  registry.add<pharos::Principled>("principled", "Disney's material for artists, opaque or clear");
  registry.add<pharos::DiffuseTransmitter>("diffuse_transmitter",
                                           "Paper and leaves: Lambert's law on both sides");
  registry.add<pharos::TwoSided>("two_sided", "Gives an opaque material a back");
  registry.add<pharos::Mask>("mask", "A material with holes that light passes straight through");
  registry.add<pharos::PassThrough>("pass_through", "A surface that is not there, around a medium");
  registry.add<pharos::Blend>("blend", "Two materials mixed");
  registry.add<pharos::BumpMap>("bump_map", "A material on a surface with bumps");
  registry.add<pharos::NormalMap>("normal_map", "A material with shading normals from a picture");
  registry.set_default<pharos::Bsdf>("diffuse");
}
