#pragma once

#include <cstddef>
#include <vector>

#include "coordinates.h"
#include "frequencies.h"

namespace pharos::aligned {

/// The deviation of the spectrum of points from a target at some frequencies:
///
///     L_spec = sum over v of w_v (sqrt(P_v) - sqrt(T_v))^2 / sum over v of w_v,
///     P_v = |F_v|^2 / N,   F_v = sum over points of exp(-2 pi i v.x).
///
/// P_v is N times the paper's power, so independent points have a power of 1 for any N. The paper
/// squares differences of powers (eq. 11). Here the loss squares differences of amplitudes: if the
/// target T is 0, the loss is the power itself, which determines the variance (eq. 5). The
/// exponentials are products of powers of exp(-2 pi i x) and exp(-2 pi i y), in single precision,
/// with sixteen points side by side. The time is proportional to N times the number of frequencies.
class PowerSpectrumLoss {
 public:
  /// Throws InputError if (0, 0) is one of the frequencies or if no frequency has a positive
  /// weight.
  explicit PowerSpectrumLoss(const std::vector<TargetPower>& frequencies);

  /// Returns the loss of `points` and adds `scale` times its gradient to `gradient`. Results are
  /// the same for any number of threads.
  double evaluate(const Coordinates& points, double scale, Coordinates& gradient) const;

  /// Returns the number of frequencies.
  std::size_t size() const { return terms_.size(); }

 private:
  /// A frequency in the half plane y >= 0.
  struct Term {
    int x, y;
    double power, weight;  ///< weights add up to one
  };
  /// The terms with the same x, in ascending order of y.
  struct Row {
    int x;
    std::size_t begin, end;
  };
  class Block;

  std::vector<double> amplitudes(const Coordinates& points) const;

  std::vector<Term> terms_;  ///< sorted by x, then y
  std::vector<Row> rows_;    ///< in ascending order of x
  int highest_y_ = 0;
};

}  // namespace pharos::aligned
