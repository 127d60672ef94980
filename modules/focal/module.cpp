#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::focal;
  registry.add<FocalLearner>(
      "focal", "A density of focal points, where light meets in space, in two octrees");
  registry.add<FocalGuider>("focal", "Directions toward focal points, or away from them");
}
