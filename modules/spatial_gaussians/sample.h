#pragma once

#include <vector>

#include <pharos/core/vec.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::spatial_gaussians {

/// A step of a path that a guide could have sampled, and the light that it found.
struct Sample {
  Point3 origin;
  Point3 target;  ///< the next vertex; for the environment, a point far outside the scene
  /// L / p: radiance along the step divided by the density of its direction, and in a medium also
  /// by the density of its length. Mean of the channels, times `steps`; 0 if no light arrived.
  float weight = 0;
  float pdf = 0;  ///< density of the direction, > 0 [1/sr]
  /// Number of steps for which it counts, > 0 [1]: one over the probability that a path survives
  /// roulette, or over the expected number of branches. It is part of `weight`.
  float steps = 1;

  void archive(Archive& archive);
};

/// Parameters of extract_samples().
struct SampleRule {
  float least_pdf = 0.1f;          ///< lower bound of densities [1/sr]
  float environment_distance = 0;  ///< distance of targets on the environment [scene units]
};

/// Appends the guidable steps of a path from the sensor. `incident` is scratch memory.
void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples);

}  // namespace pharos::spatial_gaussians
