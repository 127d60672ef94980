#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/contract/mixing.h>
#include <pharos/guiding/pipeline/training_settings.h>

namespace pharos {

/// One guiding method of a render: a learner whose model a guider samples.
struct GuidingMethod {
  Ref<Learner> learner;  ///< null: the guider samples the model of the previous method
  Ref<Guider> guider;
  /// Share of the samples, relative to the other methods that know something at a vertex.
  float weight = 1;
  std::filesystem::path model_file;  ///< file from which `model` was read; empty: none
  /// The model that guides from the start and replaces learning; null: the learner learns a model.
  std::shared_ptr<const GuidingModel> model;

  bool shares_model() const { return learner == nullptr; }
  bool learns() const { return learner != nullptr && model == nullptr; }

  static void describe(Schema<GuidingMethod>& schema);
};

/// The `guiding:` part of an integrator's settings. A single method is given in place, by
/// `learner`, `guider` and `model`. Several methods are given as a list under `methods`.
struct GuidingSettings {
  /// The largest number of methods in one render.
  static constexpr std::size_t kMostMethods = 8;

  Ref<Learner> learner;
  Ref<Guider> guider;
  /// The model file of the method in place, or of all entries of `methods` that name none.
  std::filesystem::path model_file;
  std::shared_ptr<const GuidingModel> model;  ///< of the method in place; see GuidingMethod
  std::vector<GuidingMethod> methods;
  Ref<MixingPolicy> mixing;
  /// The config of `mixing` with all its settings, as YAML on one line. Empty if the settings were
  /// not read from a config.
  std::string mixing_config;
  /// The learned state of `mixing`, as MixingState::archive() saves it. It is read from
  /// `model_file` if all models come from this file and if the same methods and the policy with
  /// the same settings wrote it; otherwise it is empty.
  std::string mixing_state;
  /// Number of candidates for each step of the final image; see sample_resampled_step().
  std::uint32_t candidates = 1;
  /// Number of the last vertex of a path that is guided; none: all vertices are. See GuidingFrame.
  std::optional<std::uint32_t> last_bounce;
  TrainingSettings training;

  static void describe(Schema<GuidingSettings>& schema);

  /// Returns the methods, in whichever form they were given. Throws InputError if neither or both
  /// forms were used, if there are more than kMostMethods, or if a method lacks a part.
  std::vector<GuidingMethod> resolved_methods() const;

  /// Returns whether any method learns. If none does, there is nothing to train.
  bool learns() const;
};

/// Reads the settings and then the model files that they name. An error in a model file is reported
/// at the place in the config that names the file.
template <>
struct Value<GuidingSettings> : PlainValue {
  static std::string type_name() { return "mapping"; }
  static std::string default_text(const GuidingSettings& settings);
  static GuidingSettings read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved);
};

}  // namespace pharos
