#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/guiding/pipeline/guiding_settings.h>

namespace pharos {

/// The learning side of a render: the state and the newest model of every method, and the state of
/// the mixing policy.
class GuidingState {
 public:
  GuidingState(const GuidingSettings& settings, const LearningContext& context);
  ~GuidingState();

  /// What guides the coming iteration; null before anything is known. It must not outlive the
  /// settings, whose guiders it uses.
  std::shared_ptr<const GuidingFrame> frame() const { return frame_; }
  void absorb(const PathLog& log);
  void update(std::uint32_t iteration, bool last);

  /// The newest model of method `i`; null before the first.
  std::shared_ptr<const GuidingModel> model(std::size_t i) const;
  /// The plugin name of the learner of method `i`.
  const std::string& learner_name(std::size_t i) const;
  /// Memory of all models [bytes].
  std::size_t model_bytes() const;

  /// Saves what was learned so far, models included, or loads it into a state for the same render.
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
