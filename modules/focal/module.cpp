#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::focal;
  registry.add<FocalLearner>("focal",
                             "Learns octrees of the points where light meets (focal path guiding)");
  registry.add<FocalGuider>("focal", "Samples directions through the points where light meets");
}
