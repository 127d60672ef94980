#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pharos::importing {

/// Limits for all files of one scene together. Each file takes its share.
struct ReadingBudget {
  std::size_t files = 4096;
  std::size_t bytes = std::size_t{256} << 20;
  std::size_t elements = 1'000'000;
  std::size_t attributes = 8'000'000;
};

/// Returns the bytes of a readable file, see file_problem(), and subtracts them from the budget. A
/// file packed by gzip is unpacked. Throws InputError if the bytes exceed the budget or reading
/// fails.
std::string read_file(const std::filesystem::path& path, ReadingBudget& budget);

}  // namespace pharos::importing
