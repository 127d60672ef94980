#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/guiding/pipeline/guiding_settings.h>

namespace pharos {

/// The learning side of a render. It holds the state and the newest model of every method, and the
/// state of the mixing policy.
class GuidingState {
 public:
  GuidingState(const GuidingSettings& settings, const LearningContext& context);
  ~GuidingState();

  /// Returns the frame that guides the next iteration; null as long as nothing is known. The frame
  /// uses the guiders of the settings and must not outlive the settings.
  std::shared_ptr<const GuidingFrame> frame() const { return frame_; }
  void absorb(const PathLog& log);
  void update(std::uint32_t iteration, bool last);

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
  std::shared_ptr<const GuidingFrame> frame_;
};

}  // namespace pharos
