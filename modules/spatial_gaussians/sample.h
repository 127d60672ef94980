#pragma once

#include <vector>

#include <pharos/core/vec.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::spatial_gaussians {

/// A step of a path that a guide could have sampled, and what came of it.
struct Sample {
  Point3 origin;
  Point3 target;     ///< the next vertex; for the environment a point far outside the scene
  float weight = 0;  ///< L / p: radiance that came along the step over its density (in a medium
                     ///< with that of its length), mean of the channels; 0 where nothing came
  float pdf = 0;     ///< of the direction, > 0 [1/sr]

  void archive(Archive& archive);
};

/// What extract_samples() needs to know.
struct SampleRule {
  float least_pdf = 0.1f;          ///< in place of smaller densities [1/sr]
  float environment_distance = 0;  ///< of the stand-ins for the environment [scene units]
};

/// Appends the guidable steps of a path from the sensor.
void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples);

}  // namespace pharos::spatial_gaussians
