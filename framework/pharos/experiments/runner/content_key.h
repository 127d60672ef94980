#pragma once

#include <string>
#include <string_view>

#include <pharos/rendering/render_config.h>

namespace pharos {

/// 32 hexadecimal digits that stand for `text` (XXH3, 128 bits).
std::string content_key(std::string_view text);

/// The same for a file's content. Throws RunError when it cannot be read.
std::string content_key_of_file(const std::filesystem::path& path);

/// The same for all that determines a render: the resolved config, but for what is written, and the
/// contents of the files it names, wherever they lie, with the buffers of glTF files. Throws
/// RunError when a file cannot be read.
std::string content_key(const LoadedConfig& loaded);

}  // namespace pharos
