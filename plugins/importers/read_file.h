#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pharos::mitsuba {

/// The bytes of a file that can be read, see file_problem(). Throws InputError for one of more than
/// `most_bytes`: `too_long` says so; and when reading fails.
std::string read_file(const std::filesystem::path& path, std::size_t most_bytes,
                      const std::string& too_long);

}  // namespace pharos::mitsuba
