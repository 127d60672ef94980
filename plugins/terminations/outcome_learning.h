#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <pharos/guiding/contract/termination.h>

#include "film_estimate.h"
#include "image_error.h"
#include "outcome_cells.h"
#include "outcome_settings.h"

namespace pharos {

/// What a rule knows: constant and thread-safe.
struct LearnedOutcomes {
  OutcomeField outcomes;
  PixelMap pixels;           ///< denoised radiance of each pixel
  float pixel_offset = 0;    ///< added to the radiance of pixels; positive
  double squared_error = 0;  ///< mean of a path, relative to its pixel [1]; 0: unknown
  double path_cost = 0;      ///< mean number of steps and light samples of a path
  float branches = 1;        ///< number of branches into which a path may split

  /// Returns the radiance to which contributions to a film position [pixels] are compared.
  float scale_at(Vec2 film) const { return pixels.at(film) + pixel_offset; }
  /// Returns into how many more branches the path of a query may split.
  float branches_left(const TerminationQuery& query) const { return branches / query.branches; }
  /// Returns what is expected to be found at the vertex of a query.
  const ExpectedOutcome& at(const TerminationQuery& query) const {
    return outcomes.at(query.position, query.towards_previous);
  }
};

/// Learns what steps and paths find, and makes a rule of it. In the first iterations, and until
/// light was found, paths end by Russian roulette with the throughput.
class OutcomeLearning final : public TerminationState {
 public:
  using Known = std::shared_ptr<const LearnedOutcomes>;
  /// Returns the rule for the next iteration; null if too little is known for one.
  using MakeRule = std::function<std::shared_ptr<const TerminationRule>(Known)>;

  OutcomeLearning(const OutcomeSettings& settings, const LearningContext& context, MakeRule make);

  void absorb(const PathLog& log) override;
  void update(const TrainingStage& stage) override;
  std::shared_ptr<const TerminationRule> rule() const override { return rule_; }
  void archive(Archive& archive) override;
  void archive_rule(Archive& archive) override;

 private:
  void learn_path(const PathView& path);
  void learn_outcomes();
  /// Returns what is known after an iteration; null if no light was found.
  Known summary() const;
  /// Makes the rule of `learned_`, if it is time to use it.
  void make_rule();
  DirectionBins directions() const { return DirectionBins(settings_.direction_rows); }

  const OutcomeSettings settings_;
  const PixelRect window_;
  const MakeRule make_;
  OutcomeReader reader_;
  std::vector<Outcome> outcomes_;  ///< since learn_outcomes() was last called
  OutcomeCells cells_;
  FilmEstimate film_;
  ImageError error_;  ///< of the current iteration, against `learned_`
  Known learned_;     ///< at the last update(); null: nothing
  /// Steps and paths of larger squared errors count as if they had this one [1]; 0: unknown.
  double largest_error_ = 0;
  std::uint32_t updates_ = 0;
  std::uint32_t uses_ = 0;  ///< number of updates after which rules were in use
  bool is_in_use_ = false;  ///< the first iterations are over
  std::shared_ptr<const TerminationRule> rule_;
};

}  // namespace pharos
