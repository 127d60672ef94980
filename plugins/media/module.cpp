#include <pharos/config/module.h>

#include "henyey_greenstein.h"
#include "homogeneous.h"
#include "isotropic.h"
#include "rayleigh.h"

PHAROS_MODULE(registry) {
  using namespace pharos;
  registry.add<HomogeneousMedium>("homogeneous", "The same everywhere, with its own colors");
  registry.add<IsotropicPhase>("isotropic", "Evenly into all directions");
  registry.add<HenyeyGreensteinPhase>("henyey_greenstein", "More or less forwards or backwards");
  registry.add<RayleighPhase>("rayleigh", "By particles much smaller than a wavelength, like air");
}
