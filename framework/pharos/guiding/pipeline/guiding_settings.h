#pragma once

#include <filesystem>
#include <memory>
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
  Ref<Learner> learner;  ///< null: the guider samples the model of the method before it
  Ref<Guider> guider;
  float weight = 1;  ///< relative share among the methods that know something at a vertex
  std::filesystem::path model_file;  ///< that `model` was read from; empty: none
  /// The model that guides from the start instead of what the learner would learn; null: it learns.
  std::shared_ptr<const GuidingModel> model;

  bool shares_model() const { return learner == nullptr; }
  bool learns() const { return learner != nullptr && model == nullptr; }

  static void describe(Schema<GuidingMethod>& schema);
};

/// The `guiding:` part of an integrator's settings. One method is given in place, several as a
/// list under `methods`.
struct GuidingSettings {
  /// Most methods of one render.
  static constexpr std::size_t kMostMethods = 8;

  Ref<Learner> learner;
  Ref<Guider> guider;
  std::filesystem::path model_file;           ///< of the method in place, as GuidingMethod's
  std::shared_ptr<const GuidingModel> model;  ///< of the method in place, as GuidingMethod's
  std::vector<GuidingMethod> methods;
  Ref<MixingPolicy> mixing;
  TrainingSettings training;

  static void describe(Schema<GuidingSettings>& schema);

  /// Returns the methods, whichever way they were given. Throws InputError if none or both ways
  /// were used, if there are more than kMostMethods, or if a method lacks a part.
  std::vector<GuidingMethod> resolved_methods() const;

  /// Returns whether any method learns. If none does, there is nothing to train.
  bool learns() const;
};

/// Reads the settings and then the model files that they name. Errors in a file are located where
/// the config names it.
template <>
struct Value<GuidingSettings> : PlainValue {
  static std::string type_name() { return "mapping"; }
  static std::string default_text(const GuidingSettings& settings);
  static GuidingSettings read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved);
};

}  // namespace pharos
