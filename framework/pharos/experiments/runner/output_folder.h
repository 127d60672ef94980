#pragma once

#include <filesystem>
#include <string>

#include <pharos/core/file_lock.h>

namespace pharos {

/// Creates the folder of an experiment's results and reserves it for this process while the lock
/// exists. Throws InputError if the folder holds the results of another file than `source`, or if
/// another process is using it.
FileLock claim_folder(const std::filesystem::path& folder, const std::filesystem::path& source);

/// Removes the files of a run, which are `stem` with any extension, so that no file of an earlier
/// config remains. Damaged files that were moved aside stay.
void remove_run(const std::filesystem::path& stem);

/// Renames a damaged file or folder to its name with `.damaged`. Returns a text that says so.
std::string moved_aside(const std::filesystem::path& path);

}  // namespace pharos
