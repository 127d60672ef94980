#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/guiding/pipeline/guiding_settings.h>
#include <pharos/guiding/pipeline/held_out_gain.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {

/// How much the guides help after training.
struct GuideGain {
  double nats = 0;      ///< gain in the last training iteration, see HeldOutGain
  bool is_off = false;  ///< it is less than TrainingSettings::least_gain: the image is not guided
};

/// The learning side of a render. It holds the state and the newest model of every method, and the
/// state of the mixing policy.
class GuidingState {
 public:
  GuidingState(const GuidingSettings& settings, const LearningContext& context);
  ~GuidingState();

  /// Returns the frame that guides the next iteration; null as long as nothing is known, if the
  /// mixing policy asks no method, and if the gain of the guides is too small in the end. The frame
  /// uses the guiders of the settings and must not outlive the settings.
  std::shared_ptr<const GuidingFrame> frame() const { return frame_; }
  void absorb(const PathLog& log);
  /// Ends the recording of an iteration. `spent` is the share of the budget that was spent. Returns
  /// whether training may end, because the gain of the guides has settled or is too small to go on.
  bool may_end_training(double spent);
  /// Returns the largest share of the budget that the next training iteration is worth [1]: all of
  /// it, or TrainingSettings::trial if the gain of the guides is known and may be too small.
  double worthwhile_share() const {
    return gain_ && gain_->may_be_below(training_.least_gain) ? training_.trial : 1;
  }
  void update(const TrainingStage& stage);

  /// Returns the gain of the guides; none if nothing depends on it, or if no iteration was guided.
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

 private:
  struct Source;
  /// A guider and the number of the source whose model it samples.
  struct User {
    Ref<Guider> guider;
    std::size_t source;
    float weight;
  };
  /// Returns whether the last iteration was guided, and its gain was too small.
  bool is_useless() const;
  std::uint32_t regions() const;
  void rebuild_frame();

  std::vector<Source> sources_;
  std::vector<User> users_;
  Ref<MixingPolicy> policy_;
  std::string policy_config_;
  std::unique_ptr<MixingState> mixing_;
  TrainingSettings training_;
  std::optional<HeldOutGain> gain_;  ///< none if its value has no consequences
  std::uint32_t candidates_ = 1;     ///< in the final image
  bool is_final_ = false;            ///< the next iteration is the final image
  bool is_off_ = false;              ///< guiding does not pay
  std::uint64_t samples_ = 0;        ///< training samples of the current iteration
  std::uint64_t last_samples_ = 0;   ///< training samples of the last iteration
  std::shared_ptr<const GuidingFrame> frame_;
};

}  // namespace pharos
