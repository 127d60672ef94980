#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::pgl;
  registry.add<PglLearner>("open_pgl", "Fields of the library Open PGL");
  registry.add<PglGuider>("open_pgl", "Directions from fields of the library Open PGL");
}
