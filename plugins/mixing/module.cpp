#include <pharos/config/module.h>

#include "fixed.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::FixedMixing>("fixed", "The same share of unguided samples everywhere");
  registry.set_default<pharos::MixingPolicy>("fixed");
}
