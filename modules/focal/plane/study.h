#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/image.h>

#include "experiment.h"
#include "focal_guide.h"
#include "path_space_guide.h"

namespace pharos::focal::plane {

/// All settings of a comparison, except the seed.
struct StudySettings {
  GapScene scene;
  TrainingPlan plan;
  PathSpaceSettings path_space;
  int positions = 512;           ///< number of points of the floor at which variances are computed
  int estimate_samples = 16384;  ///< number of samples of the estimate of the mean irradiance
};

/// The result of one technique, trained with one seed.
struct MethodResult {
  MonteCarloMean estimate;
  std::vector<double> variances;  ///< variances over the floor
  double efficiency = 1;          ///< uniform sampling's mean variance over the technique's
  double worst_to_median = 0;     ///< largest variance divided by the median variance
  double least_efficiency = 1;    ///< efficiency at the point of the floor where it is smallest
};

struct SeedResult {
  MethodResult uniform, path_space, focal;
};

/// Trains both guides with one seed and measures them.
SeedResult run_seed(const StudySettings& settings, std::uint64_t seed);

/// Trains both guides and draws figure 8, with as many new paths as a training iteration has.
Image draw_seed(const StudySettings& settings, std::uint64_t seed);

}  // namespace pharos::focal::plane
