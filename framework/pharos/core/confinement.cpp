#include <algorithm>
#include <system_error>
#include <vector>

#include <pharos/core/confinement.h>
#include <pharos/core/error.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// The folders below which input may lie, and single files, without links. Empty: anywhere.
std::vector<fs::path>& allowed_paths() {
  static std::vector<fs::path> paths;
  return paths;
}

bool lies_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

}  // namespace

void confine_reading(const fs::path& folder) {
  std::error_code failed;
  const fs::path whole = fs::canonical(folder, failed);
  if (failed || !fs::is_directory(whole, failed)) {
    throw InputError("--confine: error: expected a folder, found '" + folder.string() + "'");
  }
  allowed_paths().push_back(whole);
}

void allow_reading(const fs::path& path) {
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(path, failed);
  if (failed || whole.empty() || allowed_paths().empty()) return;
  // Without a slash at the end, which would count as one more part of the path.
  allowed_paths().push_back(whole.has_filename() ? whole : whole.parent_path());
}

std::string confinement_problem(const fs::path& file) {
  const std::vector<fs::path>& allowed = allowed_paths();
  if (allowed.empty()) return "";
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(file, failed);
  const bool is_allowed = std::any_of(allowed.begin(), allowed.end(), [&](const fs::path& path) {
    return lies_below(whole, path);
  });
  return is_allowed ? "" : "it lies outside of '" + allowed.front().string() + "' (--confine)";
}

}  // namespace pharos
