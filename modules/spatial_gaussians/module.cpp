#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::spatial_gaussians;
  registry.add<SpatialGaussiansLearner>(
      "spatial_gaussians", "Mixtures of 3D Gaussians over the points from which light arrives");
  registry.add<P0Guider>(
      "p0", "Directions to points sampled from spatial Gaussians, with the exact density");
  registry.add<P1Guider>(
      "p1",
      "Directions to points sampled from spatial Gaussians, flipped to the side of each mean");
  registry.add<ProjectedGuider>(
      "projected",
      "Directions to points sampled from spatial Gaussians, projected on planes through the means");
}
