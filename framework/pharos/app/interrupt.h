#pragma once

#include <atomic>

namespace pharos {

/// While it exists, the first signal that asks the program to end (SIGINT, SIGTERM, SIGHUP,
/// SIGUSR1, SIGUSR2) sets a flag. Another one, more than a second later, ends the program at once.
/// SIGXCPU, which comes every second once the process has used up its processor time (`ulimit -t`),
/// sets the flag, too. SIGXFSZ is ignored, so that writing beyond the limit of file sizes is an
/// error like any other. SIGHUP stays ignored under nohup.
class InterruptGuard {
 public:
  /// From now on, SIGUSR1 sets a flag of its own, also before there is a guard.
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
