#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <pharos/guiding/contract/termination.h>
#include <pharos/guiding/toolkit/pixel_estimates.h>

#include "outcome_cells.h"
#include "outcome_settings.h"
#include "path_moments.h"
#include "pixel_map.h"

namespace pharos {

/// What a rule knows: constant and thread-safe.
struct LearnedOutcomes {
  OutcomeField steps;
  PixelMap pixels;           ///< radiance of each pixel, positive
  double path_variance = 0;  ///< of a path relative to its pixel [1]; see PathMoments
  double path_cost = 0;      ///< mean number of steps of a path
};

/// Learns what steps and paths find, and makes a rule of it. Until light was found, paths end by
/// Russian roulette with the throughput.
class OutcomeLearning final : public TerminationState {
 public:
  /// Returns the rule for the next iteration; null if too little is known for one.
  using MakeRule =
      std::function<std::shared_ptr<const TerminationRule>(std::shared_ptr<const LearnedOutcomes>)>;

  OutcomeLearning(const OutcomeSettings& settings, const LearningContext& context, MakeRule make);

  void absorb(const PathLog& log) override;
  void update(const TrainingStage& stage) override;
  std::shared_ptr<const TerminationRule> rule() const override { return rule_; }
  void archive(Archive& archive) override;

 private:
  void learn_steps();
  /// Makes the rule of `learned_`, if there is one.
  void make_rule();
  PixelMap pixel_map() const;
  DirectionBins directions() const { return DirectionBins(settings_.direction_rows); }

  const OutcomeSettings settings_;
  const PixelRect window_;
  const MakeRule make_;
  OutcomeReader reader_;
  std::vector<StepOutcome> steps_;  ///< since learn_steps() was last called
  OutcomeCells cells_;
  PixelEstimates pixels_;
  PathMoments paths_;
  bool has_light_ = false;                          ///< a path has found light
  bool knows_pixels_ = false;                       ///< so did one before the last update()
  std::shared_ptr<const LearnedOutcomes> learned_;  ///< at the last update(); null: nothing
  std::shared_ptr<const TerminationRule> rule_;
};

}  // namespace pharos
