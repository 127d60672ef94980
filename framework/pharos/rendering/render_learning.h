#pragma once

#include <cstdint>
#include <memory>

#include <pharos/guiding/pipeline/guiding_state.h>
#include <pharos/rendering/integrator.h>

namespace pharos {

/// All that a render learns: its guides, and where its paths end and split. One thread at a time
/// changes it.
class RenderLearning {
 public:
  /// The learning of a render before its first iteration. `integrator` must outlive it.
  RenderLearning(const Integrator& integrator, const LearningContext& context);

  /// Returns the guides; null: the integrator has no guiding.
  const GuidingState* guiding() const { return guiding_.get(); }
  /// Returns what guides the current iteration; null: nothing does.
  const GuidingFrame* frame() const { return frame_.get(); }
  bool guides_camera() const { return frame_ != nullptr && frame_->guides_camera(); }
  /// Returns the learned rule of the current iteration; null: none is learned.
  const TerminationRule* rule() const { return rule_.get(); }

  void absorb(const PathLog& log);
  /// Ends the recording of an iteration. `cost.steps` is the number of steps of its paths, whether
  /// or not a rule is learned. Returns whether training may end; see GuideTrial::end_iteration().
  bool may_end_training(IterationCost cost);
  /// Returns the largest share of the budget that the next training iteration is worth [1].
  double worthwhile_share() const;
  /// Ends a training iteration.
  void update(const TrainingStage& stage);
  /// Returns the number of training samples of the last iteration for each region of the largest
  /// model; 0 without guides.
  double samples_per_region() const;

  /// Saves what was learned so far, or loads it into the learning of the same render.
  void archive(Archive& archive);
  /// Saves what the current iteration depends on, or loads it into the learning of the same render,
  /// which then learns no more.
  void archive_frozen(Archive& archive);

 private:
  /// Makes what was learned apply to the next iteration.
  void apply();

  std::unique_ptr<GuidingState> guiding_;
  std::unique_ptr<TerminationState> termination_;  ///< null: there is none that learns
  std::shared_ptr<const GuidingFrame> frame_;
  std::shared_ptr<const TerminationRule> rule_;
};

}  // namespace pharos
