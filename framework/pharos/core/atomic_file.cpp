#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>

#include <pharos/core/atomic_file.h>

namespace pharos {

void flush_to_disk(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // One may write into a folder whose list of files one may not read.
  if (file < 0 && errno == EACCES && std::filesystem::is_directory(path)) return;
  // Some file systems, such as remote ones, cannot flush a folder and say so with EINVAL.
  const bool is_done = file >= 0 && (fsync(file) == 0 || errno == EINVAL);
  const int error = errno;
  if (file >= 0) close(file);
  if (!is_done) {
    throw RunError("cannot write '" + path.string() + "': " + std::strerror(error));
  }
}

std::filesystem::path link_target(const std::filesystem::path& path) {
  std::error_code failed;
  const bool is_link = std::filesystem::is_symlink(path, failed);
  return is_link ? std::filesystem::weakly_canonical(path, failed) : path;
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text << std::flush;
    if (!out) throw RunError("cannot write '" + path.string() + "'");
  });
}

}  // namespace pharos
