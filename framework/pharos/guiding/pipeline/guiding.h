#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/contract/mixing.h>
#include <pharos/rendering/schedule.h>

namespace pharos {

/// One guiding method of a render.
struct GuidingMethod {
  Ref<Learner> learner;
  Ref<Guider> guider;
  float weight = 1;  ///< relative share among the methods that know something at a vertex
  std::filesystem::path model_file;  ///< that `model` was read from; empty: none
  /// What guides from the start, in place of what the learner would learn; null: it learns.
  std::shared_ptr<const GuidingModel> model;

  bool learns() const { return model == nullptr; }

  static void describe(Schema<GuidingMethod>& schema);
};

/// The `guiding:` part of an integrator's settings. One method is given in place, several as a
/// list under `methods`.
struct GuidingSettings {
  Ref<Learner> learner;
  Ref<Guider> guider;
  std::filesystem::path model_file;           ///< of the method in place, as GuidingMethod's
  std::shared_ptr<const GuidingModel> model;  ///< of the method in place, as GuidingMethod's
  std::vector<GuidingMethod> methods;
  Ref<MixingPolicy> mixing;
  TrainingSchedule training;

  static void describe(Schema<GuidingSettings>& schema);

  /// The methods, however they were given. Throws InputError when none or both ways were used, or
  /// when a learner's model is not what its guider samples, naming both.
  std::vector<GuidingMethod> resolved_methods() const;

  /// Whether any method learns; without one there is nothing to train.
  bool learns() const;
};

/// Reads the settings and then the model files that they name; what is wrong with a file is located
/// where the config names it.
template <>
struct Value<GuidingSettings> : PlainValue {
  static std::string type_name() { return "mapping"; }
  static std::string default_text(const GuidingSettings& settings);
  static GuidingSettings read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved);
};

/// What is known about where to go from a vertex.
struct Guidance {
  const GuidingDistribution* distribution = nullptr;  ///< null: sample unguided
  float unguided_fraction = 1;
  std::uint32_t region = 0;  ///< of the mixing policy
};

/// All methods of a render with their models, frozen for one iteration: constant, thread-safe.
class GuidingFrame {
 public:
  struct Method {
    std::shared_ptr<const BoundGuider> guider;  ///< null while its learner knows nothing
    float weight = 1;
    bool steers_distance = false;
    bool steers_events = false;
    bool guides_light_paths = false;
    std::uint32_t first_region = 0;  ///< regions of all methods are numbered through
  };

  GuidingFrame(std::vector<Method> methods, std::shared_ptr<const MixingFractions> fractions)
      : methods_(std::move(methods)), fractions_(std::move(fractions)) {}

  /// Guidance at a vertex: the weighted mixture of all methods that know something there.
  /// Densities of its distribution include `medium_density` where methods leave distances to the
  /// medium, so they are complete for every method alike.
  Guidance query(const GuidingQuery& query, Arena& arena) const;
  /// Guidance of the first vertex.
  Guidance query_camera(const PreparedSensor& sensor, const LensPoint& lens, Arena& arena) const;
  bool guides_camera() const;

 private:
  std::vector<Method> methods_;
  std::shared_ptr<const MixingFractions> fractions_;
};

/// The learning side of a render: every method's state, its newest model, and the mixing policy's.
class GuidingState {
 public:
  GuidingState(const GuidingSettings& settings, const LearningContext& context);
  ~GuidingState();

  /// What guides the coming iteration; null before anything is known.
  std::shared_ptr<const GuidingFrame> frame() const { return frame_; }
  void absorb(const PathLog& log);
  void update(std::uint32_t iteration, bool last);

  /// The newest model of method `i`; null before the first.
  std::shared_ptr<const GuidingModel> model(std::size_t i) const;
  /// The plugin name of the learner of method `i`.
  const std::string& learner_name(std::size_t i) const;
  /// Of all models [bytes].
  std::size_t model_bytes() const;

 private:
  struct Method;
  void rebuild_frame();

  std::vector<Method> methods_;
  std::unique_ptr<MixingState> mixing_;
  std::shared_ptr<const MixingFractions> fractions_;
  std::shared_ptr<const GuidingFrame> frame_;
};

}  // namespace pharos
