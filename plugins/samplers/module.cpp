#include <pharos/config/module.h>

#include "independent.h"
#include "sobol.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::IndependentSampler>("independent", "Independent uniform numbers");
  registry.add<pharos::SobolSampler>("sobol", "Padded (0,2)-sequences with Owen scrambling");
  registry.set_default<pharos::Sampler>("sobol");
}
