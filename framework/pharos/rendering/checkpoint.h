#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>

#include <pharos/core/file_lock.h>

/// Checkpoints: files from which a render goes on after it was killed. Numbers are little-endian.
///
///     8 bytes   "pharoscp"
///     uint32    version of this form, 1
///     uint64    length of the head [bytes]
///     head      version of Pharos, config, build, finished, length and checksum of the state
///     uint64    checksum of the head
///     the state
///
/// A text is stored as its length (uint64), followed by its bytes. checksum() makes the checksums.
namespace pharos {

/// The content of a checkpoint file.
struct SavedRender {
  std::string config;     ///< the render's config and the content of its files, as YAML
  std::string build;      ///< key of the code that rendered
  bool finished = false;  ///< whether the budget is spent
  std::string state;      ///< what RenderJob::run() takes
};

/// Writes a checkpoint. The file appears whole or not at all. Throws RunError if it cannot be
/// written; an older checkpoint then stays as it was.
void write_checkpoint(const SavedRender& checkpoint, const std::filesystem::path& path);

/// Reads a checkpoint. Throws InputError if the file is missing, unreadable or no checkpoint, if it
/// is of another form or version of Pharos, and if it is cut off or damaged.
SavedRender read_checkpoint(const std::filesystem::path& path);

/// Writes the checkpoints of one render in the background: while one is written, the render goes
/// on. No other render can write the same file in the meantime: the lock of the file
/// `path`.pharos-lock prevents it, which the destructor removes.
class CheckpointWriter {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Every checkpoint has the config and the build of `head`. One is due `every` seconds after the
  /// last one or after the start. `warn` receives the reasons why one could not be written, in the
  /// thread that calls a member function. Removes what writers that were killed have left beside
  /// `path`. Throws InputError if another render writes this checkpoint, or if `path` is a file
  /// with content that is no checkpoint. Warns if the file system has no locks.
  CheckpointWriter(const std::filesystem::path& path, SavedRender head, double every, Warn warn);
  /// Waits for the last checkpoint.
  ~CheckpointWriter();

  /// Whether a checkpoint is due. None is due while the last one is still being written.
  bool is_due();
  /// Makes one due at once.
  void request() { next_ = Clock::now(); }
  /// Writes a checkpoint in the background. If one is still being written, waits for it first.
  void write(std::string state, bool finished);
  /// Reports that there is no checkpoint this time, and why.
  void skip(const std::string& reason);
  /// Waits for the last checkpoint. Returns whether it was written.
  bool finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path path_;
  SavedRender head_;
  Clock::duration every_;
  Warn warn_;
  std::optional<FileLock> lock_;  ///< none where files cannot be locked
  Clock::time_point next_;
  std::future<void> writing_;
  bool is_written_ = true;
};

}  // namespace pharos
