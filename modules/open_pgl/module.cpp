#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"
#include "pgl_field.h"

PHAROS_MODULE(registry) {
  using namespace pharos::pgl;
  device();  // before any limit on threads is in force, which it would keep for ever
  registry.add<PglLearner>("open_pgl", "Fields of the library Open PGL");
  registry.add<PglGuider>("open_pgl", "Directions from fields of the library Open PGL");
}
