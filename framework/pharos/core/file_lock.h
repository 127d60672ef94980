#pragma once

#include <atomic>
#include <filesystem>
#include <optional>

namespace pharos {

/// A lock between processes, held as long as the object lives, by a file that is made where it is
/// not there and stays. Threads of one process each need an object of their own.
class FileLock {
 public:
  /// The lock, or nothing when another process or object holds it. Throws RunError when the file
  /// cannot be made.
  static std::optional<FileLock> try_lock(const std::filesystem::path& file);
  /// Waits for the lock; empty when `stop` was set meanwhile. `stop` may be null.
  static std::optional<FileLock> wait(const std::filesystem::path& file,
                                      const std::atomic<bool>* stop);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace pharos
