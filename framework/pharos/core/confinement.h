#pragma once

#include <filesystem>
#include <string>

namespace pharos {

/// Restricts what the process reads as input to files below `folder`, links resolved. Configs and
/// scenes of others may otherwise name any file that the user may read. Call it once, before
/// anything is read. Throws InputError if it is no folder.
void confine_reading(const std::filesystem::path& folder);

/// Makes an exception from confine_reading() for a file, or for the files below a folder. Call it
/// after confine_reading(); before, it does nothing.
void allow_reading(const std::filesystem::path& path);

/// Returns why a file may not be read, or "" if it may. file_problem() includes it.
std::string confinement_problem(const std::filesystem::path& file);

}  // namespace pharos
