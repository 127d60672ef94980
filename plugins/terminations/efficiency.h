#pragma once

#include <pharos/guiding/contract/termination.h>

#include "outcome_learning.h"

namespace pharos {

/// See efficiency.cpp.
class EfficiencyTermination final : public Termination {
 public:
  struct Settings : OutcomeSettings {
    Settings() : OutcomeSettings(1) {}
    static void describe(Schema<Settings>& s);
  };
  explicit EfficiencyTermination(const Settings& settings) : settings_(settings) {}

  bool learns() const override { return true; }
  std::unique_ptr<TerminationState> begin(const LearningContext& context) const override;

 private:
  Settings settings_;
};

/// The best factors [1] of roulette and of splitting at a vertex, for paths whose throughput equals
/// the radiance of their pixel.
struct BestFactors {
  float roulette = 0, splitting = 0;
};
/// `worth` is the mean cost of paths over their relative squared error [steps].
BestFactors best_factors(const ExpectedOutcome& expected, float worth);
/// Returns the factor [1] of a path of throughput `relative` over the radiance of its pixel.
float efficiency_factor(float relative, const BestFactors& best);

}  // namespace pharos
