#include <pharos/config/module.h>

#include "fixed.h"
#include "learned.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::FixedMixing>("fixed", "The same share of unguided samples everywhere");
  registry.add<pharos::LearnedMixing>(
      "learned", "A share of unguided samples for each region, learned by gradient descent");
  registry.set_default<pharos::MixingPolicy>("fixed");
}
