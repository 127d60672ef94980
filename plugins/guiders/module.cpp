#include <pharos/config/module.h>

#include "uniform_guider.h"
#include "uniform_learner.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::UniformLearner>("uniform",
                                       "Learns a single number: the mean incident radiance");
  registry.add<pharos::UniformGuider>("uniform",
                                      "Samples all directions uniformly, whatever was learned");
}
