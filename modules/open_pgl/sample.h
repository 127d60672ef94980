#pragma once

#include <vector>

#include <pharos/core/vec.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::open_pgl {

/// A step of a path that a guide could have sampled, and what came of it, as the library wants it.
struct Sample {
  Point3 position;
  Vec3 direction;      ///< unit
  float distance = 0;  ///< of where the light comes from, finite [scene units]
  float weight = 0;    ///< L / p, mean of the channels; 0 where nothing came
  float pdf = 0;       ///< of the direction, > 0 [1/sr]
  bool in_volume = false;

  void archive(Archive& archive);
};

/// What extract_samples() needs to know.
struct SampleRule {
  float least_pdf = 0.01f;    ///< in place of smaller densities [1/sr]
  float glossy = 0.3f;        ///< roughness below which a surface shows what is behind it
  float most_distance = 1e6;  ///< in place of larger ones: of the environment [scene units]
};

/// Memory that is kept from path to path.
struct PathScratch {
  std::vector<Rgb> incident;
  std::vector<float> distances;
};

/// Appends the guidable steps of a path from the sensor; none that is NaN or infinite, as one of
/// them is enough to make the library's field useless.
void extract_samples(const PathView& path, const SampleRule& rule, PathScratch& scratch,
                     std::vector<Sample>& samples);

}  // namespace pharos::open_pgl
