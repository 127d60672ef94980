#include <fstream>
#include <vector>

#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/experiments/runner/output_folder.h>

namespace pharos {

namespace fs = std::filesystem;

namespace {
constexpr const char* kDamaged = ".damaged";
}  // namespace

FileLock claim_folder(const fs::path& folder, const fs::path& source) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!fs::is_directory(folder, failed)) {
    throw InputError(fmt::format("{}: error: the folder cannot be made", folder.string()));
  }
  auto lock = FileLock::try_lock(folder / "experiment.lock");
  if (!lock) {
    throw InputError(fmt::format("{}: error: another process is at work here", folder.string()));
  }
  const fs::path origin = folder / "experiment.source";
  std::string known;
  std::getline(std::ifstream(origin), known);
  if (!known.empty() && known != source.string()) {
    throw InputError(
        fmt::format("{}: error: holds the results of '{}': choose another folder with "
                    "--output",
                    folder.string(), known));
  }
  if (known.empty()) write_text_atomically(origin, source.string() + "\n");
  return std::move(*lock);
}

void remove_run(const fs::path& stem) {
  if (!fs::is_directory(stem.parent_path())) return;
  const std::string start = stem.filename().string() + ".";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(stem.parent_path())) {
    const fs::path& file = entry.path();
    if (file.extension() == kDamaged) continue;
    if (file.filename().string().starts_with(start)) files.push_back(file);
  }
  for (const fs::path& file : files) fs::remove(file);
}

std::string moved_aside(const fs::path& path) {
  const fs::path aside = path.string() + kDamaged;
  fs::remove_all(aside);
  fs::rename(path, aside);
  return fmt::format("moved to '{}'", aside.string());
}

}  // namespace pharos
