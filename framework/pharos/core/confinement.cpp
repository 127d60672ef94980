#include <algorithm>
#include <system_error>

#include <pharos/core/confinement.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// The folders below which input may lie, without links. Empty: anywhere.
std::vector<fs::path>& allowed_folders() {
  static std::vector<fs::path> folders;
  return folders;
}

bool lies_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

}  // namespace

void confine_reading(const std::vector<fs::path>& folders) {
  std::error_code failed;
  for (const fs::path& folder : folders) {
    // Without a slash at the end, which would count as one more part of the path.
    const fs::path whole = fs::weakly_canonical(folder, failed);
    allowed_folders().push_back(whole.has_filename() ? whole : whole.parent_path());
  }
}

std::string confinement_problem(const fs::path& file) {
  const std::vector<fs::path>& folders = allowed_folders();
  if (folders.empty()) return "";
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(file, failed);
  const bool is_allowed = std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    return lies_below(whole, folder);
  });
  return is_allowed ? "" : "it lies outside of '" + folders.front().string() + "' (--confine)";
}

}  // namespace pharos
