#include "interrupt.h"

#include <csignal>
#include <ctime>

namespace pharos {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

/// The same cause may send two signals, one to the process and one to its group, as timeout(1)
/// does. A signal counts as a second one only if it comes more than this later.
constexpr std::time_t kSecondSignalSeconds = 1;
volatile std::sig_atomic_t first_signal_at = 0;

std::time_t monotonic_seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec;
}

void handle(int signal) {
  const std::time_t now = monotonic_seconds();
  if (!interrupted.exchange(true)) {
    first_signal_at = static_cast<std::sig_atomic_t>(now);
  } else if (now - first_signal_at > kSecondSignalSeconds) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = false;
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& InterruptGuard::flag() const {
  return interrupted;
}

}  // namespace pharos
