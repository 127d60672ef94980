#include <pharos/config/module.h>

#include "grid_guider.h"
#include "grid_learner.h"

PHAROS_MODULE(registry) {
  registry.add<grid_guide::GridLearner>(
      "grid_guide", "Histograms of the directions of light in the cells of a grid");
  registry.add<grid_guide::GridGuider>("grid_guide", "Directions sampled from a cell's histogram");
}
