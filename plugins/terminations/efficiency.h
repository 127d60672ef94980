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

/// Returns the factor [1] of a path of throughput `relative` over the radiance of its pixel.
/// `worth` is the mean cost of paths over their relative squared error [steps].
float efficiency_factor(float relative, const ExpectedOutcome& expected, float worth);

}  // namespace pharos
