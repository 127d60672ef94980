#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pharos/guiding/pipeline/guide_trial.h>
#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/guiding/pipeline/guiding_settings.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {

/// The learning side of a render. It holds the state and the newest model of every method, and the
/// state of the mixing policy.
class GuidingState {
 public:
  GuidingState(const GuidingSettings& settings, const LearningContext& context);
  ~GuidingState();

  /// Returns the frame that guides the next iteration; null as long as nothing is known, if the
  /// mixing policy asks no method, and if the guides do not help enough in the end. The frame
  /// uses the guiders of the settings and must not outlive the settings.
  std::shared_ptr<const GuidingFrame> frame() const { return frame_; }
  void absorb(const PathLog& log);
  /// Ends the recording of an iteration. Returns whether training may end; see
  /// GuideTrial::end_iteration().
  bool may_end_training(const IterationCost& cost);
  /// Returns the largest share of the budget that the next training iteration is worth [1].
  double worthwhile_share() const { return trial_ ? trial_->worthwhile_share() : 1; }
  void update(const TrainingStage& stage);

  /// Returns how much the guides help; none if nothing depends on it, or if it is unknown.
  std::optional<GuideGain> gain() const;
  /// Returns the number of training samples of the last iteration for each region of the largest
  /// model.
  double samples_per_region() const;

  /// Returns the newest model of method `i`; null if there is none yet.
  std::shared_ptr<const GuidingModel> model(std::size_t i) const;
  /// Returns everything that was learned; null as long as a method has no model.
  std::unique_ptr<const LearnedGuiding> learned() const;
  /// Returns the memory that all models use [bytes].
  std::size_t model_bytes() const;

  /// Saves what was learned so far, including models, or loads it into a state for the same render.
  /// Rendering then continues as if it had never stopped.
  void archive(Archive& archive);
  /// Saves what frame() depends on, or loads it into a state for the same render, which then only
  /// guides and does not learn.
  void archive_guides(Archive& archive);

 private:
  struct Source;
  /// A guider and the number of the source whose model it samples.
  struct User {
    Ref<Guider> guider;
    std::size_t source;
    float weight;
    bool is_out = false;  ///< it is left out of the rest of the render
  };
  /// Leaves out a method that the guides can do without, if there is one.
  void leave_out_dispensable_method();
  void mark_idle_sources();
  std::uint32_t regions() const;
  void rebuild_frame();

  std::vector<Source> sources_;
  std::vector<User> users_;
  Ref<MixingPolicy> policy_;
  std::string policy_config_;
  std::unique_ptr<MixingState> mixing_;
  std::optional<GuideTrial> trial_;  ///< none if its outcome has no consequences
  GuidingRules rules_;               ///< of the final image
  bool is_final_ = false;            ///< the next iteration is the final image
  bool is_off_ = false;              ///< guiding does not pay
  std::uint64_t samples_ = 0;        ///< training samples of the current iteration
  std::uint64_t last_samples_ = 0;   ///< training samples of the last iteration
  std::shared_ptr<const GuidingFrame> frame_;
};

}  // namespace pharos
