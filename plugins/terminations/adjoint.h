#pragma once

#include <pharos/guiding/contract/termination.h>

#include "outcome_learning.h"

namespace pharos {

/// See adjoint.cpp.
class AdjointTermination final : public Termination {
 public:
  struct Settings : OutcomeSettings {
    /// The authors of EARS begin ADRRS at the second vertex.
    Settings() : OutcomeSettings(2) {}
    float window = 5;
    static void describe(Schema<Settings>& s);
  };
  explicit AdjointTermination(const Settings& settings) : settings_(settings) {}

  bool learns() const override { return true; }
  std::unique_ptr<TerminationState> begin(const LearningContext& context) const override;

 private:
  Settings settings_;
};

/// Returns the factor [1] of a path whose expected contribution is `contribution` times the value
/// of its pixel. The contributions in the window, from 2 / (1 + `width`) to `width` times as much,
/// have the factor 1.
float weight_window_factor(float contribution, float width);

}  // namespace pharos
