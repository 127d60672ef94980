#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::gaussians;
  registry.add<GaussianLearner>("spatial_gaussians",
                                "Mixtures of 3D Gaussians of where light comes from");
  registry.add<ExactGuider>("p0", "Directions to points of spatial Gaussians");
  registry.add<FlippedGuider>(
      "p1", "Directions to points of spatial Gaussians, turned to the side of each mean");
  registry.add<ProjectedGuider>(
      "projected", "Directions to spatial Gaussians projected on planes through their means");
}
