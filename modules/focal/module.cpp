#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::focal;
  registry.add<FocalLearner>("focal", "Octrees of points where light meets (focal path guiding)");
  registry.add<FocalGuider>("focal", "Directions through the points where light meets");
}
