#include "stripes.h"

#include <pharos/config/module.h>

PHAROS_MODULE(registry) {
  registry.add<Stripes>("stripes", "Vertical stripes in two colors");
}
