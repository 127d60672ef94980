#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pharos::mitsuba {

/// What the files of one scene may cost together; each takes its share.
struct ReadingBudget {
  std::size_t bytes = std::size_t{256} << 20;
  std::size_t elements = 1'000'000;
  std::size_t attributes = 8'000'000;
};

/// The bytes of a file that can be read, see file_problem(), which it takes from the budget. Throws
/// InputError when they exceed it, and when reading fails.
std::string read_file(const std::filesystem::path& path, ReadingBudget& budget);

}  // namespace pharos::mitsuba
