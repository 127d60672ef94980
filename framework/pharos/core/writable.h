#pragma once

#include <filesystem>

namespace pharos {

/// Fails before long work, not after it, where its result could not be written: throws InputError
/// unless `file` is empty, or a regular file or none at all in a folder that may be written.
void check_writable(const std::filesystem::path& file);

}  // namespace pharos
