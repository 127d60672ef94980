#pragma once

#include <cstddef>
#include <vector>

#include "coordinates.h"
#include "frequencies.h"

namespace pharos::aligned {

/// How far the spectrum of points is from a target at some frequencies:
///
///     L_spec = sum over v of w_v (sqrt(P_v) - sqrt(T_v))^2 / sum over v of w_v,
///     P_v = |F_v|^2 / N,   F_v = sum over points of exp(-2 pi i v.x).
///
/// P_v is N times the paper's power, so that independent points have 1 for any N. The paper squares
/// differences of powers (eq. 11). Here they are of amplitudes: where nothing is wanted, T = 0, the
/// loss is the power itself, which is what variance is made of (eq. 5). The exponentials
/// are products of powers of exp(-2 pi i x) and exp(-2 pi i y), in single precision, sixteen points
/// side by side. Takes time in proportion to N times the number of frequencies.
class PowerSpectrumLoss {
 public:
  /// Frequencies (0, 0) must not be among them, and of their weights one must be positive: throws
  /// InputError.
  explicit PowerSpectrumLoss(const std::vector<TargetPower>& frequencies);

  /// The loss of `points`, `scale` times whose gradient is added to `gradient`. Results are the
  /// same for any number of threads.
  double evaluate(const Coordinates& points, double scale, Coordinates& gradient) const;

  /// How many frequencies there are.
  std::size_t size() const { return terms_.size(); }

 private:
  /// A frequency in the half plane y >= 0.
  struct Term {
    int x, y;
    double power, weight;  ///< weights add up to one
  };
  /// The terms of one x, which have ascending y.
  struct Row {
    int x;
    std::size_t begin, end;
  };
  class Block;

  std::vector<double> amplitudes(const Coordinates& points) const;

  std::vector<Term> terms_;  ///< sorted by x, then y
  std::vector<Row> rows_;    ///< of ascending x
  int highest_y_ = 0;
};

}  // namespace pharos::aligned
