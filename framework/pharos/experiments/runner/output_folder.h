#pragma once

#include <filesystem>

#include <pharos/core/file_lock.h>

namespace pharos {

/// Makes the folder of an experiment's results, and keeps it for this process as long as the lock
/// lives. Throws InputError when it holds the results of another file than `source`, or another
/// process is at work in it.
FileLock claim_folder(const std::filesystem::path& folder, const std::filesystem::path& source);

/// Removes the files of a run, `stem` with any extension, so that none of an earlier config stays.
void remove_run(const std::filesystem::path& stem);

}  // namespace pharos
