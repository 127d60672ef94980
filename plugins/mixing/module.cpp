#include <pharos/config/module.h>

#include "fixed.h"
#include "learned.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::FixedMixing>("fixed", "The same share of unguided samples everywhere");
  registry.add<pharos::LearnedMixing>("learned",
                                      "A share for each region, learned from what samples find");
  registry.set_default<pharos::MixingPolicy>("fixed");
}
