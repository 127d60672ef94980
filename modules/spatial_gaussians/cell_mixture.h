#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/random.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "learner.h"
#include "mixture_changes.h"

namespace pharos::spatial_gaussians {

/// What one cell learns: a mixture of Gaussians of the targets of its samples. What it remembers of
/// them are the moments of each component, which add up over iterations.
class CellMixture {
 public:
  /// Learns from the samples of one iteration, in their order. `scene_size` [scene units] is the
  /// same for the whole render.
  void update(std::span<const Sample> samples, const SpatialGaussiansSettings& settings,
              double scene_size, RandomStream random);
  bool knows_something() const { return mixture_.size() > 0; }
  /// What was learned so far counts `factor` times as much as it did.
  void forget(double factor);

  /// The mixture in world space; empty while nothing is known.
  std::vector<SpatialGaussian> components() const;
  /// Samples that found something, faded ones in part.
  double samples() const { return samples_; }

  void archive(Archive& archive);

 private:
  friend class CellUpdate;

  statistics::Vector<3> pivot_ = statistics::Vector<3>::Zero();  ///< all positions are from here
  double prior_variance_ = 0;                                    ///< [scene units^2]
  double samples_ = 0;
  double since_merge_ = 0;  ///< samples
  Mixture mixture_;
  std::vector<Moments3> moments_;
  std::vector<Sample> first_;         ///< that found something, kept until there are enough
  std::vector<DirectionTest> tests_;  ///< of each component since it was made
};

}  // namespace pharos::spatial_gaussians
