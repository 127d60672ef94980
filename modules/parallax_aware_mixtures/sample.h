#pragma once

#include <vector>

#include <pharos/core/vec.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::parallax_aware_mixtures {

/// A step of a path that a guide could have sampled, and the light that it found.
struct Sample {
  Point3 origin;
  Vec3 direction;              ///< unit
  float inverse_distance = 0;  ///< to the light or its image [1/scene unit]; 0: infinitely far
  float weight = 0;  ///< L / p, mean of the channels, times `steps`; 0 if no light arrived
  float pdf = 0;     ///< density of the direction, > 0 [1/sr]
  /// Number of steps for which it counts, > 0 [1]: one over the probability that a path survives
  /// roulette, or over the expected number of branches.
  float steps = 1;

  void archive(Archive& archive);
};

/// Parameters of extract_samples().
struct SampleRule {
  float least_pdf = 0.1f;  ///< lower bound of densities [1/sr]
  float glossy = 0.3f;     ///< roughness below which a surface acts as a mirror or lens
};

/// Scratch memory, kept from path to path.
struct PathScratch {
  std::vector<Rgb> incident;
  std::vector<float> distances;
};

/// Appends the guidable steps of a path from the sensor. Distances reach to images: they continue
/// past smooth surfaces, and lenses are treated as thin lenses (Ruppert et al. 2020, section 5.1).
void extract_samples(const PathView& path, const SampleRule& rule, PathScratch& scratch,
                     std::vector<Sample>& samples);

}  // namespace pharos::parallax_aware_mixtures
