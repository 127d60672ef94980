#pragma once

#include <optional>

namespace pharos {

/// Measures the largest amount of memory that the process holds after construction. Only one object
/// may be in use at a time. There is no value on systems other than Linux, and if the system does
/// not allow the measurement.
class PeakMemory {
 public:
  PeakMemory();

  /// Runs `work` without counting the memory that it holds.
  template <class Work>
  void leave_out(Work&& work) {
    take();
    work();
    reset();
  }
  /// Returns the largest resident memory so far [bytes].
  std::optional<double> bytes();

 private:
  void reset();
  void take();

  bool known_ = true;
  double peak_ = 0;
};

}  // namespace pharos
