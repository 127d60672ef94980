#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::vertex_triplets;
  registry.add<VertexTripletsLearner>(
      "vertex_triplets", "Mixtures of 9D Gaussians over three consecutive path vertices");
  registry.add<VertexTripletsGuider>(
      "vertex_triplets", "Next vertices given the previous two, and first vertices at the camera");
}
