#include "read_file.h"

#include <array>
#include <fstream>
#include <pbrt_syntax/gzip.h>
#include <utility>

#include <pharos/core/error.h>

namespace pharos::importing {

std::string read_file(const std::filesystem::path& path, ReadingBudget& budget) {
  const Location where{path.string()};
  if (budget.files == 0) throw InputError(where, "a scene may read at most 4096 files");
  --budget.files;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(where, "the file cannot be opened");
  std::string text;
  std::array<char, 1 << 16> chunk;
  while (in) {
    in.read(chunk.data(), chunk.size());
    text.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > budget.bytes) {
      throw InputError(where, "the files of a scene may have 256 MiB together");
    }
  }
  if (in.bad()) throw InputError(where, "the file cannot be read");
  try {
    text = pbrt::unpacked(std::move(text), budget.bytes);
  } catch (const InputError& error) {
    throw InputError(where, error.what());
  }
  budget.bytes -= text.size();
  return text;
}

}  // namespace pharos::importing
