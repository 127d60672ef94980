#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>

/// The input of every reader of a mesh format, and helpers that several of them need.
namespace pharos {

/// A mesh file and the part of it to read.
struct MeshSource {
  const std::filesystem::path& path;  ///< for messages, and for other files that this file names
  std::string_view bytes;
  const std::string& part;  ///< empty: everything
  /// The number of the mesh, >= 0, in formats that number their meshes; empty: any.
  std::optional<int> index = {};
};

/// Returns all bytes of a file. Devices and pipes, which may never end, are not opened. Throws
/// InputError, without the path, if there is no such file, if it is not a regular file, or if it
/// cannot be read.
std::string read_regular_file(const std::filesystem::path& path);

/// Throws InputError, with the nearest name and a list, unless `part` is empty or among `names`.
void check_part(const std::string& part, const std::set<std::string>& names);

}  // namespace pharos
