#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/random.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "learner.h"
#include "mixture_changes.h"

namespace pharos::spatial_gaussians {

/// The learning of one cell: a mixture of Gaussians over the targets of the cell's samples. From
/// one iteration to the next it keeps only the moments of each component, which add up.
class CellMixture {
 public:
  /// Learns from the samples of one iteration, in their order. `scene_size` [scene units] is the
  /// same for the whole render.
  void update(std::span<const Sample> samples, const SpatialGaussiansSettings& settings,
              double scene_size, RandomStream random);
  bool knows_something() const { return mixture_.size() > 0; }
  /// Multiplies the weight of everything learned so far by `factor`.
  void forget(double factor);

  /// Returns the mixture in world space. It is empty as long as nothing is known.
  std::vector<SpatialGaussian> components() const;
  /// Returns the number of samples that found light. forget() reduces it.
  double samples() const { return samples_; }

  void archive(Archive& archive);

 private:
  friend class CellUpdate;

  statistics::Vector<3> pivot_ = statistics::Vector<3>::Zero();  ///< origin of all positions
  /// Variances of the first samples, on surfaces and in media, and on the environment [scene
  /// units^2].
  double near_variance_ = 0, far_variance_ = 0;
  double samples_ = 0;
  double since_merge_ = 0;  ///< number of samples since the last merge
  Mixture mixture_;
  std::vector<Moments3> moments_;
  std::vector<Sample> first_;         ///< samples with light, kept until they suffice for a mixture
  std::vector<DirectionTest> tests_;  ///< one for each component, since it was made
};

}  // namespace pharos::spatial_gaussians
