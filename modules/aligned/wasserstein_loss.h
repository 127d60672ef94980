#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "coordinates.h"
#include "frequencies.h"

namespace pharos::aligned {

/// Returns the inverse of the cumulative distribution of (p - center).d for points p that are
/// uniform in the unit square (eq. 15 of the paper): the position below which the share u + 1/2 of
/// the points lies, for u in [-1/2, 1/2]. Directions that are symmetric to each other have the same
/// inverse.
double projected_quantile(Direction d, double u);

/// The deviation of points from stratification along stated directions (eq. 14 of the paper): the
/// mean squared distance of the sorted projections from the centers of strata of equal share,
///
///     L_SW = mean over directions d and points j of (N e_j)^2,
///     e_j = sorted (p.d)_j - projected_quantile(d, (j + 1/2) / N - 1/2).
///
/// Distances are in units of 1 / N, the mean width of a stratum along an axis.
class WassersteinLoss {
 public:
  /// Prepares the loss for sets of `points` points. `directions` must not be empty.
  WassersteinLoss(std::span<const Direction> directions, std::size_t points);

  /// Returns the loss of `points` and adds `scale` times its gradient to `gradient`. Results are
  /// the same for any number of threads.
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
