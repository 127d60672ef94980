#pragma once

#include <filesystem>

namespace pharos {

/// The folder for what Pharos can make again: `pharos` in $XDG_CACHE_HOME or ~/.cache, or among
/// temporary files where neither is known. It may not exist yet.
std::filesystem::path user_cache_folder();

}  // namespace pharos
