#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::parallax_aware_mixtures;
  registry.add<ParallaxAwareMixturesLearner>(
      "parallax_aware_mixtures",
      "Mixtures of von Mises-Fisher lobes that know where their light is");
  registry.add<ParallaxAwareMixturesGuider>("parallax_aware_mixtures",
                                            "Directions by von Mises-Fisher lobes, with parallax");
}
