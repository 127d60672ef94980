#include <pharos/config/module.h>

#include "bidirectional.h"
#include "light.h"
#include "path.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::PathIntegrator>(
      "path", "Unidirectional path tracing with next event estimation, MIS and guiding");
  registry.add<pharos::LightIntegrator>(
      "light", "Light tracing: paths from the lights, connected to the lens");
  registry.add<pharos::BidirectionalIntegrator>(
      "bidirectional", "Path tracing and light tracing combined by multiple importance sampling");
  registry.set_default<pharos::Integrator>("path");
}
