#include <cstdlib>

#include <pharos/core/user_cache.h>

namespace pharos {

std::filesystem::path user_cache_folder() {
  namespace fs = std::filesystem;
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const fs::path folder = cache != nullptr && *cache != '\0' ? fs::path(cache)
                          : home != nullptr && *home != '\0' ? fs::path(home) / ".cache"
                                                             : fs::temp_directory_path();
  return folder / "pharos";
}

}  // namespace pharos
