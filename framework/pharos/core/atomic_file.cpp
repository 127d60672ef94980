#include <fstream>

#include <pharos/core/atomic_file.h>

namespace pharos {

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text << std::flush;
    if (!out) throw RunError("cannot write '" + path.string() + "'");
  });
}

}  // namespace pharos
