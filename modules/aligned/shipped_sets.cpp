// The files sets/*.bin are embedded in the library. `pharos synthesize --shipped sets` writes these
// files.
#include "shipped_sets.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <pharos/core/error.h>

#include "point_set_file.h"

// Lets the assembler embed a file between two labels.
#define PHAROS_EMBED(name, file)                                              \
  asm(".pushsection .rodata\n"                                                \
      ".local " #name                                                         \
      "_begin\n"                                                              \
      ".local " #name "_end\n" #name                                          \
      "_begin:\n"                                                             \
      ".incbin \"" PHAROS_SETS_FOLDER "/" file "\"\n" #name                   \
      "_end:\n"                                                               \
      ".popsection\n");                                                       \
  extern "C" const char name##_begin[] __attribute__((visibility("hidden"))); \
  extern "C" const char name##_end[] __attribute__((visibility("hidden")))

PHAROS_EMBED(pharos_sets_64, "64.bin");
PHAROS_EMBED(pharos_sets_256, "256.bin");
PHAROS_EMBED(pharos_sets_1024, "1024.bin");
PHAROS_EMBED(pharos_sets_4096, "4096.bin");

namespace pharos::aligned {
namespace {

std::vector<PointSet> load(const char* begin, const char* end) {
  std::istringstream in(std::string(begin, end));
  return load_point_sets(in).sets;
}

/// Returns all sets of each size.
const std::array<std::vector<PointSet>, kShippedSizes.size()>& all_sets() {
  static const std::array sets{load(pharos_sets_64_begin, pharos_sets_64_end),
                               load(pharos_sets_256_begin, pharos_sets_256_end),
                               load(pharos_sets_1024_begin, pharos_sets_1024_end),
                               load(pharos_sets_4096_begin, pharos_sets_4096_end)};
  return sets;
}

}  // namespace

std::optional<PointSet> shipped_set(int direction, std::uint32_t points) {
  const auto size = std::ranges::find(kShippedSizes, points);
  if (size == kShippedSizes.end() || direction < 0) return std::nullopt;
  const auto& sets = all_sets()[static_cast<std::size_t>(size - kShippedSizes.begin())];
  const auto index = static_cast<std::size_t>(direction);
  if (index >= sets.size()) return std::nullopt;
  return sets[index];
}

}  // namespace pharos::aligned
