#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "coordinates.h"
#include "frequencies.h"

namespace pharos::aligned {

/// Inverse of the distribution of (p - center).d of points p that are uniform in the unit square
/// (eq. 15 of the paper): where the share u + 1/2 of them lies below, for u in [-1/2, 1/2].
/// Directions that are symmetric to each other have the same.
double projected_quantile(Direction d, double u);

/// How far points are from being stratified in stated directions (eq. 14 of the paper): the mean
/// squared distance of their projections, sorted, from the middles of strata of equal share,
///
///     L_SW = mean over directions d and points j of (N e_j)^2,
///     e_j = sorted (p.d)_j - projected_quantile(d, (j + 1/2) / N - 1/2).
///
/// Distances are in units of 1 / N, the mean width of a stratum along an axis.
class WassersteinLoss {
 public:
  /// For sets of `points` points; `directions` must not be empty.
  WassersteinLoss(std::span<const Direction> directions, std::size_t points);

  /// The loss of `points`, `scale` times whose gradient is added to `gradient`. Results are the
  /// same for any number of threads.
  double evaluate(const Coordinates& points, double scale, Coordinates& gradient) const;

 private:
  struct Projection {
    Direction direction;
    std::vector<double> targets;  ///< ascending
  };

  static std::vector<double> errors(const Projection& projection, const Coordinates& points);

  std::vector<Projection> projections_;
};

}  // namespace pharos::aligned
