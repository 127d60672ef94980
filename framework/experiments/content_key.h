#pragma once

#include <string>
#include <string_view>

#include <pharos/rendering/render_config.h>

namespace pharos {

/// 32 hexadecimal digits that stand for `text` (XXH3, 128 bits).
std::string content_key(std::string_view text);

/// The same for all that determines a render: the resolved config, but for what is written, and the
/// contents of the files it names, wherever they lie. Files that those name in turn, such as a
/// glTF's buffers, are not looked at. Throws RunError when a file cannot be read.
std::string content_key(const LoadedConfig& loaded);

}  // namespace pharos
