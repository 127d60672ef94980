#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"
#include "pgl_field.h"

PHAROS_MODULE(registry) {
  using namespace pharos::open_pgl;
  device();  // before any limit on threads is in force, which it would keep for ever
  registry.add<OpenPglLearner>("open_pgl", "Fields of the library Open PGL");
  registry.add<OpenPglGuider>("open_pgl", "Directions from fields of the library Open PGL");
}
