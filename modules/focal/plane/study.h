#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/image.h>

#include "experiment.h"
#include "focal_guide.h"
#include "path_space_guide.h"

namespace pharos::focal::plane {

/// Everything that one comparison depends on, but for the seed.
struct StudySettings {
  GapScene scene;
  TrainingPlan plan;
  PathSpaceSettings path_space;
  int positions = 512;           ///< on the floor, at which variances are computed
  int estimate_samples = 16384;  ///< of the estimate of the mean irradiance
};

/// What one technique gives, trained with one seed.
struct MethodResult {
  MonteCarloMean estimate;
  std::vector<double> variances;  ///< over the floor
  double efficiency = 1;          ///< uniform sampling's mean variance over this one's
  double worst_to_median = 0;     ///< of the variances
  double least_efficiency = 1;    ///< the same ratio at the point of the floor where it is least
};

struct SeedResult {
  MethodResult uniform, path_space, focal;
};

/// Trains both guides with one seed and measures them.
SeedResult run_seed(const StudySettings& settings, std::uint64_t seed);

/// The same, as figure 8 with as many fresh paths as a training iteration has.
Image draw_seed(const StudySettings& settings, std::uint64_t seed);

}  // namespace pharos::focal::plane
