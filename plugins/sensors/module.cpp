#include <pharos/config/module.h>

#include "perspective.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::PerspectiveSensor>("perspective", "A pinhole camera");
}
