#pragma once

#include <span>
#include <vector>

#include <pharos/core/bounds.h>

#include "learner.h"
#include "lobe_changes.h"
#include "lobe_mixture.h"
#include "sample.h"

namespace pharos::parallax_aware_mixtures {

/// What one cell learns: a mixture of von Mises-Fisher lobes of the directions of its samples, as
/// they are seen from a pivot, the mean of their origins.
class CellMixture {
 public:
  /// Learns from the samples of one iteration, in their order.
  void update(std::span<const Sample> samples, const ParallaxAwareMixturesSettings& settings);
  bool knows_something() const { return !mixture_.empty(); }
  /// What was learned so far counts `factor` times as much as it did.
  void forget(double factor);

  const Mixture& mixture() const { return mixture_; }
  std::vector<double> inverse_distances() const;
  Point3 pivot() const;
  /// Samples that found something, faded ones in part.
  double samples() const { return found_; }

  void archive(Archive& archive);

 private:
  friend class CellUpdate;

  Direction pivot_ = Direction::Zero();
  double origins_ = 0;      ///< samples that the pivot is the mean of
  double found_ = 0;        ///< samples that found something
  double since_merge_ = 0;  ///< samples
  Mixture mixture_;
  std::vector<Moments> moments_;
  std::vector<Assessment> assessments_;  ///< of each lobe since it was made
  std::vector<Sample> first_;            ///< kept until there are enough for a mixture
};

}  // namespace pharos::parallax_aware_mixtures
