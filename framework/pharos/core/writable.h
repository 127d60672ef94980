#pragma once

#include <filesystem>

namespace pharos {

/// Checks before long work that its result can be written. Throws InputError unless `file` is
/// empty, or names a regular file or no existing file in a writable folder.
void check_writable(const std::filesystem::path& file);

}  // namespace pharos
