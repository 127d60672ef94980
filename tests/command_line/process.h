#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pharos/tests/fixtures.h>

namespace pharos::testing {

/// The result of a run of the program.
struct Outcome {
  /// Exit code of the shell: 124 after kTimeoutSeconds, more than 128 for a signal. Sanitizers exit
  /// with 1.
  int exit_code = 0;
  std::string out, err;
  double peak_megabytes = 0;  ///< largest resident memory
};

/// A program that takes longer is considered to hang. Under a sanitizer on a busy machine, some
/// take half a minute.
inline constexpr int kTimeoutSeconds = 300;

/// Runs `pharos ARGUMENTS` through a shell in `folder`. `environment` may be, for example,
/// "NAME=value".
Outcome run_pharos(const std::string& arguments, const std::filesystem::path& folder,
                   const std::string& environment = "");
/// Runs the program as above as `ranks` processes of mpirun, which have one thread each. Only
/// builds with MPI can do this.
Outcome run_on_ranks(int ranks, const std::string& arguments, const std::filesystem::path& folder);
/// Runs the program as above and sends `signal` ("INT", "TERM") after `seconds`.
Outcome interrupt_pharos(const std::string& arguments, const std::filesystem::path& folder,
                         double seconds, const char* signal);
/// Runs the program as above and sends `signal` as soon as `file` is in `folder`. On a busy machine
/// this may take long; the limit is two minutes.
Outcome interrupt_pharos_once(const std::string& file, const std::string& arguments,
                              const std::filesystem::path& folder, const char* signal,
                              const std::string& environment = "");
/// Runs the program as above and sends `signal` as soon as the shell command `condition` succeeds,
/// which is tried again and again until the program ends.
Outcome interrupt_pharos_when(const std::string& condition, const std::string& arguments,
                              const std::filesystem::path& folder, const char* signal,
                              const std::string& environment = "");
/// Waits for a file for at most two minutes. Returns whether the file exists.
bool appears(const std::filesystem::path& file);

/// Runs `pharos ARGUMENTS` on a separate terminal, which receives both output and messages: `out`
/// is everything that it received, and `err` is empty.
Outcome run_pharos_on_terminal(const std::string& arguments, const std::filesystem::path& folder);

/// An empty folder that is deleted by the destructor, with the files that a run of the program left
/// there.
class ScratchFolder : public test::TemporaryFolder {
 public:
  bool has(const std::string& name) const { return std::filesystem::exists(*this / name); }
  std::size_t file_count() const;
  /// Returns every file and folder below this one, with sizes, sorted.
  std::vector<std::string> listing() const;
};

}  // namespace pharos::testing
