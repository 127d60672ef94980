#include <pharos/config/module.h>

#include "bidirectional.h"
#include "light.h"
#include "path.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::PathIntegrator>(
      "path", "Unidirectional path tracing with next event estimation, MIS and guiding");
  registry.add<pharos::LightIntegrator>("light", "Paths from the lights, seen through the lens");
  registry.add<pharos::BidirectionalIntegrator>(
      "bidirectional", "Paths from the lens and from the lights, weighted together");
  registry.set_default<pharos::Integrator>("path");
}
