#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::ppg;
  registry.add<SdTreeLearner>("sd_tree", "Directional quadtrees of radiance in a binary tree");
  registry.add<SdTreeGuider>("sd_tree", "Directions in proportion to an SD-tree");
}
