#pragma once

#include <cstdint>
#include <vector>

#include "guide.h"
#include "scene.h"

namespace pharos::focal::plane {

/// The schedule of a guide's training.
struct TrainingPlan {
  int iterations = 6;
  int samples = 4096;  ///< number of samples per iteration, uniformly random over the floor
  double guided_fraction = 0.5;  ///< share of guided samples from the second iteration on
};

/// A mixture of the densities of `guide`, which may be null, and uniform densities.
struct Technique {
  const Guide* guide = nullptr;
  double guided_fraction = 0;

  MixedDensity at(double x) const {
    return {guide != nullptr ? guide->at(x) : nullptr, guided_fraction};
  }
};

/// Draws `count` paths from random points of the floor and returns the paths that found light.
std::vector<Path> draw_paths(const GapScene& scene, const Technique& technique, int count,
                             RandomStream& random);

/// Trains `guide` from its initial state. The paths are a function of `seed`.
void train(Guide& guide, const GapScene& scene, const TrainingPlan& plan, std::uint64_t seed);

/// A mean and its standard error [both in the unit of irradiance].
struct MonteCarloMean {
  double value = 0, standard_error = 0;
};
/// Estimates the mean irradiance of the floor from `count` paths, and the standard error from the
/// same paths.
MonteCarloMean estimate_irradiance(const GapScene& scene, const Technique& technique, int count,
                                   RandomStream& random);

/// Returns the variance of the one-sample estimator of the irradiance at `x`. The variance is
/// computed by quadrature over the lit angles and therefore has no noise: it includes outliers
/// before they occur.
double local_variance(const GapScene& scene, const Technique& technique, double x);

/// Returns local_variance() at `positions` evenly spaced points of the floor, from left to right.
std::vector<double> variance_profile(const GapScene& scene, const Technique& technique,
                                     int positions);

/// The summary of a variance profile.
struct Evenness {
  double mean = 0;
  double worst_to_median = 0;
};
/// Summarizes a profile. The mean is proportional to the expected squared error of an image of the
/// floor.
Evenness evenness(std::vector<double> profile);

}  // namespace pharos::focal::plane
