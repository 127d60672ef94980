#pragma once

#include <atomic>

namespace pharos {

/// While it exists, the first SIGINT or SIGTERM sets a flag. Another one, more than a second later,
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
