#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pharos {

/// Restricts what the process reads as input to files below `folders`, links resolved. Configs and
/// scenes of others may otherwise name any file that the user may read. Call it once, before
/// anything is read.
void confine_reading(const std::vector<std::filesystem::path>& folders);

/// Returns why a file may not be read, or "" if it may. file_problem() includes it.
std::string confinement_problem(const std::filesystem::path& file);

}  // namespace pharos
