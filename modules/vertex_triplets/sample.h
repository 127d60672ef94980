#pragma once

#include <vector>

#include <pharos/guiding/record/path_record.h>

#include "triplet.h"

namespace pharos::vertex_triplets {

/// A triplet of a recorded path with the sum of f/p over the path's completions through it
/// (Schuessler et al. 2022, eq. 32). The weight is the luminance of their part of the mean over all
/// pixels. Each completion has its MIS weight among the techniques from which samples are taken.
struct Sample {
  Triplet triplet;
  float weight = 0;  ///< > 0

  void archive(Archive& archive);
};

/// Parameters of extract_samples().
struct SampleRule {
  EnvironmentShell environment;
  bool light_paths = false;  ///< also takes samples of paths from lights
};

/// Appends the samples of a path. `incident` is scratch memory.
void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples);

}  // namespace pharos::vertex_triplets
