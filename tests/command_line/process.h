#pragma once

#include <filesystem>
#include <string>

namespace pharos::testing {

/// What a run of the program left behind.
struct Outcome {
  int exit_code = 0;
  std::string out, err;
};

/// Runs `pharos ARGUMENTS` through a shell in `folder`.
Outcome run_pharos(const std::string& arguments, const std::filesystem::path& folder);
/// As above, with `signal` ("INT", "TERM") after `seconds`.
Outcome interrupt_pharos(const std::string& arguments, const std::filesystem::path& folder,
                         double seconds, const char* signal);

/// An empty folder that goes away again.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& text) const;
  bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
  std::size_t file_count() const;

 private:
  std::filesystem::path path_;
};

}  // namespace pharos::testing
