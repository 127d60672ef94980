#pragma once

#include <vector>

#include <pharos/guiding/record/path_record.h>

#include "triplet.h"

namespace pharos::vertex_triplets {

/// A triplet of a recorded path with the sum of f/p over the path's completions through it
/// (Schuessler et al. 2022, eq. 32). The weight is a luminance, of what SampleWeights says. Each
/// completion has its MIS weight among the techniques from which samples are taken.
struct Sample {
  Triplet triplet;
  float weight = 0;  ///< > 0

  void archive(Archive& archive);
};

/// The weights of samples. All of them suit surfaces and media, because the factors of a medium
/// along a step belong to the step as the BSDF does. Only `path` suits paths from lights.
enum class SampleWeights {
  /// The path's part of the mean over all pixels, as published. It is the only weight that paths
  /// from both ends have in common: the scales of their prefixes and suffixes differ by orders of
  /// magnitude.
  path,
  /// f/p of the path from the triplet's middle vertex on, without the throughput to this vertex.
  /// Conditionals given the first two vertices have the same expectation as with `path`, because
  /// the prefix cancels (eq. 15) and thus only adds variance. The mixture of all prefixes then
  /// has the density of the sampled prefixes, not of their flux. Pairs do not know the first
  /// vertex. Their conditionals are means over the sampled first vertices, which is as good on
  /// rough surfaces. Colors of the prefix do not count. Samples whose first vertex is the sensor
  /// keep the weight of the path, because first vertices are sampled by their part of the image.
  suffix,
  /// The weight of the path over the value of its pixel relative to the mean of the image
  /// (PixelEstimates). Paths to dark pixels then count as much as paths to bright pixels, also
  /// for first vertices. The pixels of paths from lights are unknown.
  relative
};

/// Parameters of extract_samples().
struct SampleRule {
  EnvironmentShell environment;
  bool light_paths = false;  ///< also takes samples of paths from lights
  /// Whether next event estimates of paths from the sensor are samples themselves. They always
  /// count as light that leaves their vertex, so in the weights of steps to this vertex.
  /// Connections of paths from lights to the lens are always samples.
  bool light_samples = true;
  bool suffixes = false;  ///< weights are SampleWeights::suffix
  float scale = 1;        ///< factor of all weights
};

/// Appends the samples of a path. `incident` is scratch memory.
void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples);

}  // namespace pharos::vertex_triplets
