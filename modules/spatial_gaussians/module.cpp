#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::spatial_gaussians;
  constexpr const char* kPaper =
      "S. Lelyakin, V. Schüßler, C. Dachsbacher: Sampling of Anisotropic Spatial Gaussians for "
      "Path Guiding. 2025";
  registry.add<SpatialGaussiansLearner>(
      "spatial_gaussians", "Mixtures of 3D Gaussians over the points from which light arrives",
      {kPaper});
  registry.add<P0Guider>(
      "p0", "Directions to points sampled from spatial Gaussians, with the exact density",
      {kPaper});
  registry.add<P1Guider>(
      "p1", "Directions to points sampled from spatial Gaussians, flipped to the side of each mean",
      {kPaper});
  registry.add<ProjectedGuider>(
      "projected",
      "Directions to points sampled from spatial Gaussians, projected on planes through the means",
      {kPaper});
}
