#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>

/// What every reader of a mesh format gets, and what several of them need.
namespace pharos {

/// A mesh file, and which part of it is wanted.
struct MeshSource {
  const std::filesystem::path& path;  ///< for messages, and for the files that this one names
  std::string_view bytes;
  const std::string& part;  ///< empty: everything
  /// The number of the wanted mesh, >= 0, in formats that count them; empty: any.
  std::optional<int> index = {};
};

/// All bytes of a file. Devices and pipes, which may never end, are not opened. Throws InputError,
/// without the path, when there is no such file, and when it is not a regular one or cannot be
/// read.
std::string read_regular_file(const std::filesystem::path& path);

/// Throws InputError, with the nearest name and a list, unless `part` is empty or among `names`.
void check_part(const std::string& part, const std::set<std::string>& names);

}  // namespace pharos
