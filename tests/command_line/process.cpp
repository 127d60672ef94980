#include "process.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <pty.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

namespace pharos::testing {
namespace {

std::string read_and_remove(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return text;
}

[[noreturn]] void become_shell(const std::string& line) {
  execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
  _exit(127);
}

/// Waits for the shell. The caller fills in `out` and `err`.
Outcome outcome_of(pid_t shell) {
  int status = -1;
  rusage usage{};
  wait4(shell, &status, 0, &usage);
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = {},
          .err = {},
          .peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024};
}

Outcome run_shell(const std::string& command, const std::filesystem::path& folder) {
  // Several threads may run programs in one folder.
  static std::atomic<int> runs{0};
  const int run = ++runs;
  const auto out = folder / fmt::format(".stdout-{}", run);
  const auto err = folder / fmt::format(".stderr-{}", run);
  const std::string line = fmt::format("cd '{}' && {} > '{}' 2> '{}'", folder.string(), command,
                                       out.string(), err.string());
  const pid_t shell = fork();
  if (shell == 0) become_shell(line);
  Outcome outcome = outcome_of(shell);
  outcome.out = read_and_remove(out);
  outcome.err = read_and_remove(err);
  return outcome;
}

}  // namespace

Outcome run_pharos(const std::string& arguments, const std::filesystem::path& folder,
                   const std::string& environment) {
  return run_shell(fmt::format("{} timeout --kill-after=10 {} {} {}", environment, kTimeoutSeconds,
                               PHAROS_PROGRAM, arguments),
                   folder);
}

#ifdef PHAROS_MPIRUN
Outcome run_on_ranks(int ranks, const std::string& arguments, const std::filesystem::path& folder) {
  const char* const root = geteuid() == 0 ? "--allow-run-as-root" : "";
  // Open MPI leaks memory in libraries that it unloads. The leak sanitizer then does not know the
  // names of their functions, so these leaks cannot be suppressed.
  return run_shell(
      fmt::format("ASAN_OPTIONS=detect_leaks=0 timeout --kill-after=10 {} '{}' -n {} "
                  "--oversubscribe --bind-to none {} '{}' {} --threads 1",
                  kTimeoutSeconds, PHAROS_MPIRUN, ranks, root, PHAROS_PROGRAM, arguments),
      folder);
}
#endif

Outcome interrupt_pharos(const std::string& arguments, const std::filesystem::path& folder,
                         double seconds, const char* signal) {
  // Unless it is in the foreground, timeout(1) kills itself too and does not wait for the program,
  // which holds its locks until it has ended.
  return run_shell(fmt::format("timeout --foreground --preserve-status --signal={} {} {} {}",
                               signal, seconds, PHAROS_PROGRAM, arguments),
                   folder);
}

Outcome interrupt_pharos_when(const std::string& condition, const std::string& arguments,
                              const std::filesystem::path& folder, const char* signal,
                              const std::string& environment) {
  return run_shell(
      fmt::format(
          "{{ {} '{}' {} & until {}; do kill -0 $! || break; done; kill -{} $!; wait $!; }}",
          environment, PHAROS_PROGRAM, arguments, condition, signal),
      folder);
}

Outcome interrupt_pharos_once(const std::string& file, const std::string& arguments,
                              const std::filesystem::path& folder, const char* signal,
                              const std::string& environment) {
  const std::string appears =
      fmt::format("{{ sleep 0.05; n=$((n+1)); [ -e '{}' ] || [ $n -ge 2400 ]; }}", file);
  return interrupt_pharos_when(appears, arguments, folder, signal, environment);
}

bool appears(const std::filesystem::path& file) {
  for (int i = 0; i < 2400 && !std::filesystem::exists(file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return std::filesystem::exists(file);
}

Outcome run_pharos_on_terminal(const std::string& arguments, const std::filesystem::path& folder) {
  const std::string line = fmt::format("cd '{}' && timeout {} {} {}", folder.string(),
                                       kTimeoutSeconds, PHAROS_PROGRAM, arguments);
  int terminal = -1;
  const pid_t shell = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (shell == 0) become_shell(line);
  std::string received;
  char buffer[4096];
  // Reading fails when the other side has been closed.
  for (ssize_t count; (count = read(terminal, buffer, sizeof buffer)) > 0;) {
    received.append(buffer, static_cast<std::size_t>(count));
  }
  close(terminal);
  Outcome outcome = outcome_of(shell);
  outcome.out = std::move(received);
  return outcome;
}

std::vector<std::string> ScratchFolder::listing() const {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path())) {
    const std::uintmax_t size = entry.is_regular_file() ? entry.file_size() : 0;
    all.push_back(fmt::format("{} {}", entry.path().string(), size));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::size_t ScratchFolder::file_count() const {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path())) ++count;
  return count;
}

}  // namespace pharos::testing
