#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include <pharos/core/error.h>
#include <pharos/core/file_lock.h>

namespace pharos {
namespace {

constexpr std::chrono::milliseconds kPause{100};

}  // namespace

std::optional<FileLock> FileLock::try_lock(const std::filesystem::path& file) {
  for (;;) {
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) throw RunError("cannot write '" + file.string() + "'");
    FileLock lock(descriptor, file);
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) return std::nullopt;
      throw RunError("cannot lock '" + file.string() + "': " + std::strerror(errno));
    }
    // Between opening and locking, the last owner may have removed the file.
    if (lock.has_name()) return lock;
  }
}

std::optional<FileLock> FileLock::wait(const std::filesystem::path& file,
                                       const std::atomic<bool>* stop) {
  for (;;) {
    if (std::optional<FileLock> lock = try_lock(file)) return lock;
    if (stop != nullptr && stop->load()) return std::nullopt;
    std::this_thread::sleep_for(kPause);
  }
}

void FileLock::remove_file() const {
  if (has_name()) unlink(file_.c_str());
}

bool FileLock::has_name() const {
  struct stat locked, named;
  return fstat(descriptor_, &locked) == 0 && stat(file_.c_str(), &named) == 0 &&
         locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), file_(std::move(other.file_)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(file_, other.file_);
  return *this;
}

}  // namespace pharos
