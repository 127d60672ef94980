#pragma once

#include <chrono>

namespace pharos {

/// Measures wall-clock time without pauses.
class Stopwatch {
 public:
  /// Starts at `seconds`.
  explicit Stopwatch(double seconds = 0)
      : start_(Clock::now() - std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(seconds))) {}

  double seconds() const { return std::chrono::duration<double>(elapsed()).count(); }

  /// Runs `work` without counting its time.
  template <class Work>
  void pause(Work&& work) {
    const Clock::duration before = elapsed();
    work();
    start_ = Clock::now() - before;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::duration elapsed() const { return Clock::now() - start_; }

  Clock::time_point start_;
};

}  // namespace pharos
