#pragma once

#include <filesystem>

namespace pharos {

/// Returns the folder for files that Pharos can create again: `pharos` in $XDG_CACHE_HOME or
/// ~/.cache, or in the folder for temporary files if neither is known. The folder may not exist
/// yet.
std::filesystem::path user_cache_folder();

}  // namespace pharos
