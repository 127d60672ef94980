#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <pharos/core/file_lock.h>
#include <pharos/experiments/runner/claims.h>

namespace pharos {

/// Returns the folder of the claims on the runs of an experiment.
std::filesystem::path claims_folder(const std::filesystem::path& output);

/// The start of the names under which processes claim a place at the work. No run's claim begins
/// like this, because every scene has a name.
inline constexpr const char* kWorkerClaims = "@";

/// The place of this process among those that work on one experiment in one folder.
class Workplace {
 public:
  /// Creates the folder. `plan` is a plan_key(). Throws InputError if the folder holds results of
  /// an experiment file that is not `source`, or if other processes work there on another plan.
  Workplace(const std::filesystem::path& folder, const std::filesystem::path& source,
            const std::string& plan);

  ClaimBoard& board() { return board_; }
  /// Whether this process was the first one at work.
  bool is_first() const { return is_first_; }

 private:
  ClaimBoard board_;
  std::optional<Claim> own_;
  bool is_first_ = true;
};

/// Reserves a folder for this process alone. It creates the folder. Throws InputError if the folder
/// holds results of an experiment file that is not `source`, or if another process has reserved it.
FileLock claim_folder(const std::filesystem::path& folder, const std::filesystem::path& source);

/// Removes the files of a run, which are `stem` with any extension, so that no file of an earlier
/// config remains. Damaged files that were moved aside stay.
void remove_run(const std::filesystem::path& stem);

/// Renames a damaged file or folder to its name with `.damaged`. Returns a text that says so.
std::string moved_aside(const std::filesystem::path& path);

}  // namespace pharos
