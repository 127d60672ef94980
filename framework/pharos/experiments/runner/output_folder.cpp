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

/// Creates the folder and notes whose results it holds. Throws InputError if it holds others.
void reserve(const fs::path& folder, const fs::path& source) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!fs::is_directory(folder, failed)) {
    throw InputError(fmt::format("{}: error: the folder cannot be made", folder.string()));
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
}

fs::path reserved_claims_folder(const fs::path& folder, const fs::path& source) {
  reserve(folder, source);
  return claims_folder(folder);
}

}  // namespace

fs::path claims_folder(const fs::path& output) {
  return output / "claims";
}

Workplace::Workplace(const fs::path& folder, const fs::path& source, const std::string& plan)
    : board_(reserved_claims_folder(folder, source)) {
  const Claimant self = Claimant::self();
  const std::string own = fmt::format("{}{}@{}@{}", kWorkerClaims, plan, self.host, self.process);
  own_ = board_.try_claim(own);
  for (const std::string& other : board_.names(kWorkerClaims)) {
    if (other == own) continue;
    const std::optional<Claimant> who = board_.holder(other);
    if (!who) {
      board_.try_claim(other);  // gives it back at once, so nothing remains of a dead process
      continue;
    }
    if (!other.starts_with(kWorkerClaims + plan)) {
      throw InputError(
          fmt::format("{}: error: another process is at work here, with other configs, another "
                      "build of Pharos or another type of machine ({}, process {})",
                      folder.string(), who->host, who->process));
    }
    is_first_ &= std::pair(self.since, own) < std::pair(who->since, other);
  }
}

FileLock claim_folder(const fs::path& folder, const fs::path& source) {
  reserve(folder, source);
  auto lock = FileLock::try_lock(folder / "experiment.lock");
  if (!lock) {
    throw InputError(fmt::format("{}: error: another process is at work here", folder.string()));
  }
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
  std::error_code failed;
  fs::remove_all(aside, failed);
  fs::rename(path, aside, failed);
  if (failed) return fmt::format("cannot be moved aside ({})", failed.message());
  return fmt::format("moved to '{}'", aside.string());
}

}  // namespace pharos
