#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pharos/tests/fixtures.h>

namespace pharos::testing {

/// What a run of the program left behind.
struct Outcome {
  /// As the shell tells it: 124 after kTimeoutSeconds, over 128 for a signal; sanitizers exit
  /// with 1.
  int exit_code = 0;
  std::string out, err;
  double peak_megabytes = 0;  ///< largest resident memory
};

/// A program that takes longer hangs.
inline constexpr int kTimeoutSeconds = 30;

/// Runs `pharos ARGUMENTS` through a shell in `folder`; `environment` is such as "NAME=value".
Outcome run_pharos(const std::string& arguments, const std::filesystem::path& folder,
                   const std::string& environment = "");
/// As above, with `signal` ("INT", "TERM") after `seconds`.
Outcome interrupt_pharos(const std::string& arguments, const std::filesystem::path& folder,
                         double seconds, const char* signal);
/// As above, with `signal` once `file` is in `folder`, however long that takes on a busy machine
/// (at most two minutes).
Outcome interrupt_pharos_once(const std::string& file, const std::string& arguments,
                              const std::filesystem::path& folder, const char* signal);
/// Waits for a file for at most two minutes; whether it is there.
bool appears(const std::filesystem::path& file);

/// Runs `pharos ARGUMENTS` on a terminal of its own, which takes output and messages alike: `out`
/// is all that it received, `err` is empty.
Outcome run_pharos_on_terminal(const std::string& arguments, const std::filesystem::path& folder);

/// An empty folder that goes away again, and what a run of the program left there.
class ScratchFolder : public test::TemporaryFolder {
 public:
  bool has(const std::string& name) const { return std::filesystem::exists(*this / name); }
  std::size_t file_count() const;
  /// Every file and folder below it, with sizes, sorted.
  std::vector<std::string> listing() const;
};

}  // namespace pharos::testing
