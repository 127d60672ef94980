#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::focal;
  constexpr const char* kPaper =
      "A. Rath, Ö. Yazici, P. Slusallek: Focal Path Guiding for Light Transport Simulation. "
      "SIGGRAPH Conference Papers, 2023";
  registry.add<FocalLearner>(
      "focal", "A density of focal points, where light meets in space, in two octrees", {kPaper});
  registry.add<FocalGuider>("focal", "Directions toward focal points, or away from them", {kPaper});
}
