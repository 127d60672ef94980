#include <pharos/config/module.h>

#include "conductor.h"
#include "dielectric.h"
#include "diffuse.h"
#include "rough_conductor.h"
#include "rough_dielectric.h"
#include "thin_dielectric.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::Diffuse>("diffuse", "Lambert's cosine law on the outer side");
  registry.add<pharos::Conductor>("conductor", "Mirror of a polished metal");
  registry.add<pharos::RoughConductor>("rough_conductor", "GGX microfacets of a metal");
  registry.add<pharos::Dielectric>("dielectric", "Smooth glass: mirror reflection and refraction");
  registry.add<pharos::RoughDielectric>("rough_dielectric", "GGX microfacets of a clear medium");
  registry.add<pharos::ThinDielectric>("thin_dielectric", "Clear pane without thickness");
  registry.set_default<pharos::Bsdf>("diffuse");
}
