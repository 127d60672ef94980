#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <pharos/guiding/contract/learner.h>

/// Files of learned models: train once, render many times. A file is a head, which any program can
/// read, followed by what GuidingModel::archive() writes. Numbers are little-endian.
///
///     8 bytes   "pharosgm"
///     uint32    version of this form, 2
///     text      plugin name of the learner        (a text: its length as uint32, its bytes)
///     text      ModelInfo::name
///     uint32    ModelInfo::version
///     uint64    length of the rest [bytes]
///
/// Errors in a file are InputErrors without location that name the file in quotes.
namespace pharos {

/// The head of a model file.
struct ModelHeader {
  std::string learner;        ///< plugin name of the learner that can read it
  std::string model;          ///< ModelInfo::name
  std::uint32_t version = 0;  ///< ModelInfo::version
  std::uint64_t bytes = 0;    ///< length of the model itself
};

/// Writes a model that the learner of this plugin name made. The file appears whole or not at all;
/// throws RunError.
void write_model_file(const GuidingModel& model, std::string_view learner,
                      const std::filesystem::path& path);

/// The head alone. Throws InputError when the file is missing or unreadable, no model file, of
/// another version of this form, cut off, or longer than its head says.
ModelHeader read_model_header(const std::filesystem::path& path);

/// The model. Throws InputError as read_model_header() does, and for a model of another learner, of
/// another version than this learner writes, or damaged. Never null.
std::shared_ptr<const GuidingModel> read_model_file(const std::filesystem::path& path,
                                                    const Learner& learner);

}  // namespace pharos
