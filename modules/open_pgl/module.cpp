#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"
#include "pgl_field.h"

PHAROS_MODULE(registry) {
  using namespace pharos::open_pgl;
  device();  // made before any limit on threads is set, because the device would keep this limit
  registry.add<OpenPglLearner>("open_pgl",
                               "Fields of the library Open PGL: directional mixtures or quadtrees "
                               "in the cells of a kd-tree");
  registry.add<OpenPglGuider>("open_pgl", "Directions sampled from fields of the library Open PGL");
}
