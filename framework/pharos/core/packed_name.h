#pragma once

#include <filesystem>
#include <strings.h>

namespace pharos {

/// Returns the name of the file that a file packed by gzip holds: "room.pbrt" for "room.pbrt.gz".
/// Other names are returned as they are.
inline std::filesystem::path unpacked_name(const std::filesystem::path& path) {
  const bool is_packed = strcasecmp(path.extension().c_str(), ".gz") == 0;
  return is_packed ? std::filesystem::path(path).replace_extension() : path;
}

}  // namespace pharos
