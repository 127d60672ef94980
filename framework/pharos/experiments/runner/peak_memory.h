#pragma once

#include <optional>

namespace pharos {

/// Measures the most memory that the process holds from its construction on. One at a time; Linux
/// only: elsewhere, and where the system does not allow it, there is no value.
class PeakMemory {
 public:
  PeakMemory();

  /// Runs `work` without counting what it holds.
  template <class Work>
  void leave_out(Work&& work) {
    take();
    work();
    reset();
  }
  /// The most memory resident so far [bytes].
  std::optional<double> bytes();

 private:
  void reset();
  void take();

  bool known_ = true;
  double peak_ = 0;
};

}  // namespace pharos
