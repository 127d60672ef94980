#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/contract/mixing.h>

/// Files of what a render has learned: train once, render many times. A file consists of a head,
/// which any program can read, and of the data that GuidingModel::archive() and
/// MixingState::archive() write. Numbers are little-endian.
///
///     8 bytes   "pharosgm"
///     uint32    version of this form, 5
///     list      models: ModelHeader       (a list: its length as uint64, its elements)
///     list      methods: LearnedMethod
///     text      plugin name of the mixing policy    (a text: its length as uint64, its bytes)
///     text      settings of the policy, as YAML on one line
///     uint64    length of what the policy has learned [bytes]
///     the models in the same order, then what the policy has learned
///     uint64    checksum() of all bytes before it
///
/// Errors in a file throw an InputError without location that names the file in quotes.
namespace pharos {

/// The part of a model file's head that describes a model.
struct ModelHeader {
  std::string learner;        ///< plugin name of the learner that can read it
  std::string model;          ///< ModelInfo::name
  std::uint32_t version = 0;  ///< ModelInfo::version
  std::uint64_t bytes = 0;    ///< length of the model itself [bytes]

  void archive(Archive& archive) { archive(learner, model, version, bytes); }
};

/// A guiding method as it was learned.
struct LearnedMethod {
  std::uint32_t model = 0;  ///< number of the model that its guider samples
  float weight = 1;         ///< GuidingMethod::weight

  void archive(Archive& archive) { archive(model, weight); }
};

/// The head of a model file.
struct ModelFileHead {
  std::vector<ModelHeader> models;
  std::vector<LearnedMethod> methods;
  std::string mixing;              ///< plugin name of the mixing policy
  std::string mixing_config;       ///< the policy with its settings: a config of one line
  std::uint64_t mixing_bytes = 0;  ///< length of what the policy has learned [bytes]

  void archive(Archive& archive) { archive(models, methods, mixing, mixing_config, mixing_bytes); }
};

/// A model and the plugin name of the learner that has learned it.
struct LearnedModel {
  std::string learner;
  std::shared_ptr<const GuidingModel> model;  ///< never null
};

/// Everything that a render has learned.
struct LearnedGuiding {
  std::vector<LearnedModel> models;
  std::vector<LearnedMethod> methods;
  std::string mixing;         ///< plugin name of the mixing policy
  std::string mixing_config;  ///< GuidingSettings::mixing_config
  std::string mixing_state;   ///< what MixingState::archive() saves
};

/// Writes what was learned. The file appears whole or not at all. Throws RunError if it cannot be
/// written.
void write_model_file(const LearnedGuiding& learned, const std::filesystem::path& path);

/// Returns the head of a file. Throws InputError if the file is missing, unreadable or no model
/// file, if it has another version of this form, if it is cut off, or if it is longer than its head
/// says.
ModelFileHead read_model_head(const std::filesystem::path& path);

/// Returns the first model in a file that `learner` can read, or, if `skip` is not 0, one after so
/// many others; never null. Throws InputError in the same cases as read_model_head(), and also if
/// there is no such model, if its version differs from the one that this learner writes, or if it
/// is damaged.
std::shared_ptr<const GuidingModel> read_model_file(const std::filesystem::path& path,
                                                    const Learner& learner, std::size_t skip = 0);

/// Returns what the mixing policy of a file has learned, as MixingState::archive() has saved it.
/// Throws InputError in the same cases as read_model_head().
std::string read_mixing_state(const std::filesystem::path& path);

/// Loads `saved`, which read_mixing_state() returned for the file, into the state of a policy with
/// the same settings. Throws InputError if `saved` is damaged.
void load_mixing_state(const std::filesystem::path& path, const std::string& saved,
                       MixingState& state);

}  // namespace pharos
