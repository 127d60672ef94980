#pragma once

#include <vector>

#include <pharos/guiding/record/path_record.h>

#include "triplet.h"

namespace pharos::vertex_triplets {

/// A triplet of a recorded path with the sum of f/p of the path's completions through it: their
/// luminance, part of the mean over all pixels, each way by its MIS weight among the ways that
/// samples are taken of (Schuessler et al. 2022, eq. 32).
struct Sample {
  Triplet triplet;
  float weight = 0;  ///< > 0

  void archive(Archive& archive);
};

/// Which samples are taken.
struct SampleRule {
  EnvironmentShell environment;
  bool light_paths = false;  ///< of paths from lights too
};

/// Appends the samples of a path. `incident` is scratch memory, kept from call to call.
void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples);

}  // namespace pharos::vertex_triplets
