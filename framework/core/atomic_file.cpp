#include <fstream>

#include <pharos/core/atomic_file.h>

namespace pharos {

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text << std::flush;
    if (!out) throw RunError(path.string() + ": error: cannot be written");
  });
}

}  // namespace pharos
