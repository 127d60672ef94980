#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::triplets;
  registry.add<TripletLearner>("vertex_triplets",
                               "Mixtures of 9D Gaussians over three vertices of a path");
  registry.add<TripletGuider>("vertex_triplets",
                              "Next vertices by where the path comes from, and first ones");
}
