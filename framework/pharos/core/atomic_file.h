#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <pharos/core/error.h>

namespace pharos {

/// Waits until a file, or the list of files in a folder, is on the disk. Throws RunError if it
/// cannot be opened or written.
void flush_to_disk(const std::filesystem::path& path);

/// Returns the file that a symbolic link points to, whether it exists or not; `path` itself if it
/// is no link.
std::filesystem::path link_target(const std::filesystem::path& path);

/// Writes the file `path` as a whole or not at all. `write(temporary)` writes a temporary file
/// beside it, which is then renamed. If write() throws or the renaming fails, the temporary file is
/// removed, an existing `path` stays as it was, and the error propagates. If `path` is a symbolic
/// link, the link stays and the file that it points to is replaced. When the function returns, the
/// file is on the disk, so that it survives even a loss of power. Throws RunError if the folder
/// does not exist, or if `path` exists and is not a regular file: devices and folders are never
/// replaced.
template <class Write>
void write_atomically(const std::filesystem::path& path, Write&& write) {
  namespace fs = std::filesystem;
  const auto fail = [&](const std::string& why) {
    throw RunError("cannot write '" + path.string() + "': " + why);
  };
  std::error_code failed;
  const fs::path target = link_target(path);
  if (fs::exists(target, failed) && !fs::is_regular_file(target, failed)) {
    fail("it is not a regular file");
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, failed)) fail("there is no folder '" + folder.string() + "'");
  const fs::path temporary = target.string() + "." + std::to_string(getpid()) + ".tmp";
  try {
    std::forward<Write>(write)(temporary);
    flush_to_disk(temporary);
    fs::rename(temporary, target, failed);
    if (failed) fail(failed.message());
    flush_to_disk(folder);
  } catch (...) {
    fs::remove(temporary, failed);
    throw;
  }
}

/// Writes `text` to the file `path`, as a whole or not at all. Throws RunError.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace pharos
