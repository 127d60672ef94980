#pragma once

#include <span>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/core/random.h>

#include "learner.h"
#include "lobe_changes.h"
#include "lobe_mixture.h"
#include "sample.h"

namespace pharos::parallax_aware_mixtures {

/// The learning of one cell: a mixture of von Mises-Fisher lobes over the directions of the cell's
/// samples, as seen from a pivot. The pivot is the mean of the samples' origins.
class CellMixture {
 public:
  /// Learns from the samples of one iteration, in their order. `random` chooses the samples of a
  /// fit.
  void update(std::span<const Sample> samples, const ParallaxAwareMixturesSettings& settings,
              RandomStream random);
  bool knows_something() const { return !mixture_.empty(); }
  /// Multiplies the weight of everything learned so far by `factor`.
  void forget(double factor);

  const Mixture& mixture() const { return mixture_; }
  std::vector<double> inverse_distances() const;
  Point3 pivot() const;
  /// Returns the number of samples that found light. forget() reduces it.
  double samples() const { return found_; }

  void archive(Archive& archive);

 private:
  friend class CellUpdate;

  Direction pivot_ = Direction::Zero();
  double origins_ = 0;      ///< number of samples whose mean is the pivot
  double found_ = 0;        ///< number of samples that found light
  double since_merge_ = 0;  ///< number of samples since the last merge
  Mixture mixture_;
  std::vector<Moments> moments_;
  std::vector<Assessment> assessments_;  ///< one for each lobe, since it was made
  std::vector<Sample> first_;            ///< samples that are kept until they suffice for a mixture
};

}  // namespace pharos::parallax_aware_mixtures
