#pragma once

#include <vector>

#include <pharos/core/vec.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::parallax_aware_mixtures {

/// A step of a path that a guide could have sampled, and what came of it.
struct Sample {
  Point3 origin;
  Vec3 direction;              ///< unit
  float inverse_distance = 0;  ///< of where the light comes from [1/scene unit]; 0: infinitely far
  float weight = 0;            ///< L / p, mean of the channels; 0 where nothing came
  float pdf = 0;               ///< of the direction, > 0 [1/sr]

  void archive(Archive& archive);
};

/// What extract_samples() needs to know.
struct SampleRule {
  float least_pdf = 0.1f;  ///< in place of smaller densities [1/sr]
  float glossy = 0.3f;     ///< roughness below which a surface shows what is behind it
};

/// Memory that is kept from path to path.
struct PathScratch {
  std::vector<Rgb> incident;
  std::vector<float> distances;
};

/// Appends the guidable steps of a path from the sensor. Distances are those of images: they go on
/// past smooth surfaces, through lenses as far as thin ones would show (Ruppert et al. 2020,
/// section 5.1).
void extract_samples(const PathView& path, const SampleRule& rule, PathScratch& scratch,
                     std::vector<Sample>& samples);

}  // namespace pharos::parallax_aware_mixtures
