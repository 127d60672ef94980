#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::vertex_triplets;
  constexpr const char* kPaper =
      "V. Schüßler, J. Hanika, A. Jung, C. Dachsbacher: Path Guiding with Vertex Triplet "
      "Distributions. Computer Graphics Forum 41(4), 2022";
  registry.add<VertexTripletsLearner>(
      "vertex_triplets", "Mixtures of 9D Gaussians over three consecutive path vertices", {kPaper});
  registry.add<VertexTripletsGuider>(
      "vertex_triplets", "Next vertices given the previous two, and first vertices at the camera",
      {kPaper});
}
