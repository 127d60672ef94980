#pragma once

#include <vector>

#include <pharos/core/vec.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::open_pgl {

/// A step of a path that a guide could have sampled, and the light that it found, as the library
/// expects them.
struct Sample {
  Point3 position;
  Vec3 direction;      ///< unit
  float distance = 0;  ///< distance of the light or its image, finite [scene units]
  float weight = 0;    ///< L / p, mean of the channels; 0 if no light arrived
  float pdf = 0;       ///< density of the direction, > 0 [1/sr]
  bool in_volume = false;

  void archive(Archive& archive);
};

/// Parameters of extract_samples().
struct SampleRule {
  float least_pdf = 0.01f;    ///< lower bound of densities [1/sr]
  float glossy = 0.3f;        ///< roughness below which a surface acts as a mirror or lens
  float most_distance = 1e6;  ///< upper bound, and distance of the environment [scene units]
};

/// Scratch memory, kept from path to path.
struct PathScratch {
  std::vector<Rgb> incident;
  std::vector<float> distances;
};

/// Appends the guidable steps of a path from the sensor. Drops samples with NaN or infinite values,
/// because one of them makes the library's field useless.
void extract_samples(const PathView& path, const SampleRule& rule, PathScratch& scratch,
                     std::vector<Sample>& samples);

}  // namespace pharos::open_pgl
