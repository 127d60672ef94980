#include <pharos/config/module.h>

#include "henyey_greenstein.h"
#include "homogeneous.h"
#include "isotropic.h"
#include "rayleigh.h"

PHAROS_MODULE(registry) {
  using namespace pharos;
  registry.add<HomogeneousMedium>("homogeneous",
                                  "A medium whose coefficients are the same everywhere");
  registry.add<IsotropicPhase>("isotropic", "Even scattering in all directions");
  registry.add<HenyeyGreensteinPhase>("henyey_greenstein",
                                      "Scattering mostly forwards or backwards");
  registry.add<RayleighPhase>("rayleigh",
                              "Scattering by particles much smaller than a wavelength, as in air");
}
