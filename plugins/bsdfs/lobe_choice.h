#pragma once

#include <algorithm>

#include <pharos/core/vec.h>

namespace pharos {

/// A random choice between two lobes. It rescales the random number for reuse, so that samples stay
/// stratified.
class LobeChoice {
 public:
  /// Chooses in proportion to weights >= 0 of any unit. If both are zero, there is nothing to
  /// choose.
  LobeChoice(float first, float second) {
    const float sum = first + second;
    if (sum <= 0) return;
    first_ = first / sum;
    second_ = second / sum;
  }

  /// Probabilities [1]. They add up to one, or both are zero.
  float first() const { return first_; }
  float second() const { return second_; }
  bool nothing() const { return first_ == 0 && second_ == 0; }

  /// Returns whether `u` in [0,1) chooses the first lobe. Replaces `u` by its relative position
  /// within the chosen interval, which is again uniform on [0,1).
  bool takes_first(float& u) const {
    const bool first = u < first_;
    u = first ? u / first_ : (u - first_) / second_;
    u = std::min(u, kOneMinusEpsilon);
    return first;
  }

 private:
  float first_ = 0, second_ = 0;
};

}  // namespace pharos
