#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::vmf;
  registry.add<VmfLearner>("vmf_mixtures",
                           "Mixtures of von Mises-Fisher lobes that know where their light is");
  registry.add<VmfGuider>("vmf_mixtures", "Directions by von Mises-Fisher lobes, with parallax");
}
