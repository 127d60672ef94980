#pragma once

#include <atomic>

namespace pharos {

/// While it exists, the first signal that asks the program to end (SIGINT, SIGTERM, SIGHUP,
/// SIGUSR2) sets a flag. Another one, more than a second later, ends the program at once. SIGUSR1
/// sets a flag of its own. SIGXFSZ is ignored, so that writing beyond the limit of file sizes is an
/// error like any other. SIGHUP stays ignored under nohup.
class InterruptGuard {
 public:
  /// Makes SIGUSR1 set its flag already before there is a guard. Otherwise it ends the program.
  static void expect_requests();

  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether the program was asked to end.
  const std::atomic<bool>& flag() const;
  /// Asks the program to end.
  void set();
  /// Whether SIGUSR1 came since the last call.
  bool take_request();
};

}  // namespace pharos
