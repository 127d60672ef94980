#include <pharos/config/module.h>

#include "uniform_guider.h"
#include "uniform_learner.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::UniformLearner>("uniform", "How bright the scene is: one number");
  registry.add<pharos::UniformGuider>("uniform", "All directions alike, whatever was learned");
}
