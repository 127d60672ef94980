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

/// Returns the best number [1] of steps or light samples whose estimates have the spread `spread`.
/// `relative` is the throughput of the path over the radiance of its pixel, times sqrt(C_I / V_I).
float efficiency_factor(float relative, const Spread& spread);

}  // namespace pharos
