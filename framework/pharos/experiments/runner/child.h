#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace pharos {

/// Limits on the time and memory of a child process.
struct ChildLimits {
  std::optional<double> seconds;  ///< wall-clock time
  std::optional<double> bytes;    ///< address space
};

/// How a child process ended.
struct ChildEnd {
  bool is_stopped = false;  ///< it ended or failed after it was asked to end
  std::string problem;      ///< why it failed; empty: it did not
};

/// Runs a program with its arguments and waits for its end. When `stop` becomes true, the program
/// is asked to end (SIGTERM). A program that exceeds its time is killed.
ChildEnd run_child(const std::vector<std::string>& command, const ChildLimits& limits,
                   const std::atomic<bool>* stop);

}  // namespace pharos
