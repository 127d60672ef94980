#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/rendering/render_config.h>

namespace pharos {

/// Returns a hash of `text` as 32 hexadecimal digits (XXH3, 128 bits).
std::string content_key(std::string_view text);

/// Returns the hash of a file's content. Throws RunError if the file cannot be read.
std::string content_key_of_file(const std::filesystem::path& path);

/// Returns the hash of an image's pixels.
std::string pixels_key(const Image& image);

/// Returns the files that a render reads: the files of its config, those that it names, and the
/// buffers of glTF files.
std::vector<std::filesystem::path> inputs_of(const LoadedConfig& loaded);

/// Returns everything that determines a render: the resolved config without its output, in which
/// the paths of files are replaced by hashes of their contents. Throws RunError if a file cannot be
/// read.
ConfigNode content_of(const LoadedConfig& loaded);

/// Returns the hash of everything that determines a render: the resolved config without its output,
/// and the contents of the files it names, wherever they are stored, including the buffers of glTF
/// files. Throws RunError if a file cannot be read.
std::string content_key(const LoadedConfig& loaded);

}  // namespace pharos
