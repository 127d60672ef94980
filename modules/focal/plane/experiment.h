#pragma once

#include <cstdint>
#include <vector>

#include "guide.h"
#include "scene.h"

namespace pharos::focal::plane {

/// How a guide is trained.
struct TrainingPlan {
  int iterations = 6;
  int samples = 4096;            ///< of each iteration, spread evenly by chance over the floor
  double guided_fraction = 0.5;  ///< from the second iteration on
};

/// How densities are mixed: those of `guide`, which may be null, and uniform ones.
struct Technique {
  const Guide* guide = nullptr;
  double guided_fraction = 0;

  MixedDensity at(double x) const {
    return {guide != nullptr ? guide->at(x) : nullptr, guided_fraction};
  }
};

/// Draws `count` paths from random points of the floor and returns those that found light.
std::vector<Path> draw_paths(const GapScene& scene, const Technique& technique, int count,
                             RandomStream& random);

/// Trains `guide` from its initial state; the paths are a function of `seed`.
void train(Guide& guide, const GapScene& scene, const TrainingPlan& plan, std::uint64_t seed);

/// A mean with its standard error [both unit of irradiance].
struct MonteCarloMean {
  double value = 0, standard_error = 0;
};
/// The floor's mean irradiance from `count` paths, with the error that they show.
MonteCarloMean estimate_irradiance(const GapScene& scene, const Technique& technique, int count,
                                   RandomStream& random);

/// The variance of the estimator of one sample for the irradiance at `x`. By quadrature over the
/// angles that are lit, so that it has no noise of its own: it sees outliers before they occur.
double local_variance(const GapScene& scene, const Technique& technique, double x);

/// local_variance() over the floor at `positions` evenly spaced points, from left to right.
std::vector<double> variance_profile(const GapScene& scene, const Technique& technique,
                                     int positions);

/// What a profile says of a technique.
struct Evenness {
  double mean = 0;
  double worst_to_median = 0;
};
/// The mean is proportional to the expected squared error of an image of the floor.
Evenness evenness(std::vector<double> profile);

}  // namespace pharos::focal::plane
