#include "render_outputs.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/writable.h>
#include <pharos/experiments/runner/content_key.h>

namespace pharos {
namespace {

/// The files that a render writes, by the name of their setting.
std::vector<std::pair<const char*, std::filesystem::path>> outputs_of(
    const OutputSettings& output) {
  std::vector<std::pair<const char*, std::filesystem::path>> outputs;
  const auto add = [&](const char* name, const std::filesystem::path& file) {
    if (!file.empty()) outputs.emplace_back(name, file);
  };
  add("image", output.image);
  if (output.png) {
    add("png", std::filesystem::path(output.image).replace_extension(".png"));
  }
  add("model", output.model);
  add("checkpoint", output.checkpoint);
  return outputs;
}

/// Returns the absolute path without links, also of a file that does not exist; empty if it cannot
/// be found out.
std::filesystem::path without_links(const std::filesystem::path& file) {
  std::error_code failed;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file, failed), failed);
}

/// Opens a file without a name in a folder; a negative number if that fails. Where the file system
/// has no such files, it removes the name at once.
int open_nameless(const std::filesystem::path& folder) {
  const int file = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (file >= 0) return file;
  std::string name = (folder / ".pharos-XXXXXX").string();
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) unlink(name.c_str());
  return named;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code failed;
  if (std::filesystem::equivalent(a, b, failed)) return true;
  const std::filesystem::path whole = without_links(a);
  return !whole.empty() && whole == without_links(b);
}

/// Checks that no output is an input or another output.
void check_distinct(const LoadedConfig& loaded) {
  const auto outputs = outputs_of(loaded.config.output);
  const std::vector<std::filesystem::path> inputs = inputs_of(loaded);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [name, file] = outputs[i];
    for (const std::filesystem::path& input : inputs) {
      if (!is_same_file(file, input)) continue;
      throw InputError(
          fmt::format("{}: error: 'output.{}' would overwrite an input of this "
                      "render: expected another name",
                      file.string(), name));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (!is_same_file(file, outputs[k].second)) continue;
      throw InputError(
          fmt::format("{}: error: 'output.{}' and 'output.{}' name the same file: expected two",
                      file.string(), outputs[k].first, name));
    }
  }
}

}  // namespace

void check_outputs(const LoadedConfig& loaded) {
  const OutputSettings& output = loaded.config.output;
  const std::filesystem::path image = output.image;
  if (image.extension() != ".exr") {
    throw InputError(
        fmt::format("{}: error: images are OpenEXR files: expected a name that ends "
                    "in .exr",
                    output.image));
  }
  for (const auto& [name, file] : outputs_of(output)) check_writable(file);
  check_distinct(loaded);
}

OutputSpace::OutputSpace(const RenderConfig& config) {
  constexpr int kColors = 3, kMostChannels = 3;
  const std::filesystem::path image = config.output.image;
  const std::filesystem::path folder = image.has_parent_path() ? image.parent_path() : ".";
  file_ = open_nameless(folder);
  if (file_ < 0) return;
  const std::size_t channels = kColors + kMostChannels * config.output.aovs.size();
  const std::size_t bytes = config.film.window().area() * channels * sizeof(float);
  const int error = posix_fallocate(file_, 0, static_cast<off_t>(bytes));
  if (error == 0) return;
  release();
  if (error == ENOSPC || error == EDQUOT || error == EFBIG) {
    throw RunError(fmt::format("{}: error: the image needs up to {} bytes: {}", image.string(),
                               bytes, std::strerror(error)));
  }
}

OutputSpace::~OutputSpace() {
  release();
}

void OutputSpace::release() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

}  // namespace pharos
