#include <pharos/config/module.h>

#include "path.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::PathIntegrator>(
      "path", "Unidirectional path tracing with next event estimation, MIS and guiding");
  registry.set_default<pharos::Integrator>("path");
}
