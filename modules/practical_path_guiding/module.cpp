#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::practical_path_guiding;
  registry.add<PracticalPathGuidingLearner>("practical_path_guiding",
                                            "Directional quadtrees of radiance in a binary tree");
  registry.add<PracticalPathGuidingGuider>("practical_path_guiding",
                                           "Directions in proportion to an SD-tree");
}
