#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/guiding/pipeline/guiding_settings.h>
#include <pharos/guiding/pipeline/held_out_gain.h>

namespace pharos {

/// The learning side of a render. It holds the state and the newest model of every method, and the
/// state of the mixing policy.
class GuidingState {
 public:
  GuidingState(const GuidingSettings& settings, const LearningContext& context);
  ~GuidingState();

  /// Returns the frame that guides the next iteration; null as long as nothing is known, and if the
  /// mixing policy asks no method. The frame uses the guiders of the settings and must not outlive
  /// the settings.
  std::shared_ptr<const GuidingFrame> frame() const { return frame_; }
  void absorb(const PathLog& log);
  /// Ends the recording of an iteration. Returns whether training may end, because the guides
  /// hardly explain its paths better than the guides before; see TrainingSettings::tolerance.
  bool settles() { return gain_ && gain_->settles(tolerance_); }
  void update(const TrainingStage& stage);

  /// Returns the number of training samples of the last iteration for each region of the largest
  /// model.
  double samples_per_region() const;

  /// Returns the newest model of method `i`; null if there is none yet.
  std::shared_ptr<const GuidingModel> model(std::size_t i) const;
  /// Returns the plugin name of the learner of method `i`.
  const std::string& learner_name(std::size_t i) const;
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
  };
  std::uint32_t regions() const;
  void rebuild_frame();

  std::vector<Source> sources_;
  std::vector<User> users_;
  std::unique_ptr<MixingState> mixing_;
  double tolerance_;
  std::optional<HeldOutGain> gain_;  ///< none if training never ends early
  std::uint64_t samples_ = 0;        ///< training samples of the current iteration
  std::uint64_t last_samples_ = 0;   ///< training samples of the last iteration
  std::shared_ptr<const GuidingFrame> frame_;
};

}  // namespace pharos
