#include "interrupt.h"

#include <csignal>
#include <cstdint>
#include <ctime>

namespace pharos {
namespace {

std::atomic<bool> interrupted{false};
std::atomic<bool> requested{false};     ///< SIGUSR1 came
std::atomic<bool> has_requests{false};  ///< SIGUSR1 sets `requested`
/// When the first signal came [s]; 0: there was none. Two signals may arrive on two threads at the
/// same time.
std::atomic<std::int64_t> first_signal_at{0};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "set from a signal handler");

/// The same cause may send two signals, one to the process and one to its group, as timeout(1)
/// does. A signal counts as a second one only if it comes more than this later.
constexpr std::int64_t kSecondSignalSeconds = 1;

/// Returns the time on a clock that starts at 1 s.
std::int64_t monotonic_seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec + 1;
}

void handle(int signal) {
  const std::int64_t now = monotonic_seconds();
  std::int64_t first = 0;
  if (first_signal_at.compare_exchange_strong(first, now)) {
    interrupted = true;
  } else if (now - first > kSecondSignalSeconds) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

void handle_request(int) {
  requested = true;
}

void handle_end_of_time(int) {
  interrupted = true;
}

constexpr int kEnding[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR2};

/// Sets the handler of a signal. SIGHUP stays ignored if it is, because nohup ignores it.
void set_handler(int signal, void (*handler)(int)) {
  const auto before = std::signal(signal, handler);
  if (signal == SIGHUP && before == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace

void InterruptGuard::expect_requests() {
  has_requests = true;
  set_handler(SIGUSR1, handle_request);
}

InterruptGuard::InterruptGuard() {
  interrupted = false;
  first_signal_at = 0;
  for (const int signal : kEnding) set_handler(signal, handle);
  set_handler(SIGUSR1, has_requests ? handle_request : handle);
  set_handler(SIGXCPU, handle_end_of_time);
  std::signal(SIGXFSZ, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : kEnding) set_handler(signal, SIG_DFL);
  set_handler(SIGUSR1, SIG_DFL);
  set_handler(SIGXCPU, SIG_DFL);
}

const std::atomic<bool>& InterruptGuard::flag() const {
  return interrupted;
}

void InterruptGuard::set() {
  interrupted = true;
}

bool InterruptGuard::take_request() {
  return requested.exchange(false);
}

}  // namespace pharos
