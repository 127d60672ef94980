#include <pharos/config/module.h>

#include "fixed.h"
#include "learned.h"
#include "simplex.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::FixedMixing>("fixed", "The same share of unguided samples everywhere");
  registry.add<pharos::LearnedMixing>(
      "learned", "A share of unguided samples for each region, learned by gradient descent");
  registry.add<pharos::SimplexMixing>(
      "simplex", "Shares of unguided sampling and of every method that minimize the variance");
  registry.set_default<pharos::MixingPolicy>("fixed");
}
