#include "read_file.h"

#include <array>
#include <fstream>

#include <pharos/core/error.h>

namespace pharos::mitsuba {

std::string read_file(const std::filesystem::path& path, std::size_t most_bytes,
                      const std::string& too_long) {
  const Location where{path.string()};
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(where, "the file cannot be opened");
  std::string text;
  std::array<char, 1 << 16> chunk;
  while (in) {
    in.read(chunk.data(), chunk.size());
    text.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes) throw InputError(where, too_long);
  }
  if (in.bad()) throw InputError(where, "the file cannot be read");
  return text;
}

}  // namespace pharos::mitsuba
