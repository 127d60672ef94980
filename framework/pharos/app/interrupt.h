#pragma once

#include <atomic>

namespace pharos {

/// While it lives, the first SIGINT or SIGTERM sets a flag; another one, a second or more later,
/// ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const std::atomic<bool>& flag() const;
};

}  // namespace pharos
