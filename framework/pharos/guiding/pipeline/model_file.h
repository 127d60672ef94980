#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <pharos/guiding/contract/learner.h>

/// Files of learned models: train once, render many times. A file consists of a head, which any
/// program can read, and of the data that GuidingModel::archive() writes. Numbers are
/// little-endian.
///
///     8 bytes   "pharosgm"
///     uint32    version of this form, 2
///     text      plugin name of the learner        (a text: its length as uint32, its bytes)
///     text      ModelInfo::name
///     uint32    ModelInfo::version
///     uint64    length of the rest [bytes]
///
/// Errors in a file throw an InputError without location that names the file in quotes.
namespace pharos {

/// The head of a model file.
struct ModelHeader {
  std::string learner;        ///< plugin name of the learner that can read it
  std::string model;          ///< ModelInfo::name
  std::uint32_t version = 0;  ///< ModelInfo::version
  std::uint64_t bytes = 0;    ///< length of the model itself [bytes]
};

/// Writes a model that was learned by the learner with the plugin name `learner`. The file appears
/// whole or not at all. Throws RunError if it cannot be written.
void write_model_file(const GuidingModel& model, std::string_view learner,
                      const std::filesystem::path& path);

/// Returns the head of a file. Throws InputError if the file is missing, unreadable or no model
/// file, if it has another version of this form, if it is cut off, or if it is longer than its head
/// says.
ModelHeader read_model_header(const std::filesystem::path& path);

/// Returns the model in a file; never null. Throws InputError in the same cases as
/// read_model_header(), and also if another learner made the model, if its version differs from the
/// one that this learner writes, or if it is damaged.
std::shared_ptr<const GuidingModel> read_model_file(const std::filesystem::path& path,
                                                    const Learner& learner);

}  // namespace pharos
