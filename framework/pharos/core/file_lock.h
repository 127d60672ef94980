#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <utility>

namespace pharos {

/// A lock between processes, held as long as the object lives. The lock is on a file, which is
/// created if it does not exist and stays afterwards, unless it is removed. Threads of one process
/// need one object each.
class FileLock {
 public:
  /// Returns the lock, or nothing if another process or object holds it. Throws RunError if the
  /// file cannot be created, or if its file system has no locks.
  static std::optional<FileLock> try_lock(const std::filesystem::path& file);
  /// Waits for the lock. Returns nothing if `stop` is set in the meantime; `stop` may be null.
  /// Throws RunError like try_lock().
  static std::optional<FileLock> wait(const std::filesystem::path& file,
                                      const std::atomic<bool>* stop);

  /// Removes the file of this lock, which stays locked. A file that has taken its place stays.
  void remove_file() const;

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  FileLock(int descriptor, std::filesystem::path file)
      : descriptor_(descriptor), file_(std::move(file)) {}
  /// Whether the locked file still has its name.
  bool has_name() const;

  int descriptor_ = -1;
  std::filesystem::path file_;
};

}  // namespace pharos
