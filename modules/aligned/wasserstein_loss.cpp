#include "wasserstein_loss.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <pharos/core/parallel.h>

namespace pharos::aligned {

double projected_quantile(Direction d, double u) {
  const double c = std::max(std::abs(d.x), std::abs(d.y));
  const double s = std::min(std::abs(d.x), std::abs(d.y));
  // The square has constant height around its center. Further outside, its corners reduce the
  // height.
  if (2 * c * std::abs(u) <= c - s) return u * c;
  const double from_corner = std::sqrt(2 * s * c * std::max(0.0, 0.5 - std::abs(u)));
  return std::copysign((c + s) / 2 - from_corner, u);
}

WassersteinLoss::WassersteinLoss(std::span<const Direction> directions, std::size_t points) {
  for (const Direction d : directions) {
    Projection projection{d, std::vector<double>(points)};
    for (std::size_t j = 0; j < points; ++j) {
      const double u = (static_cast<double>(j) + 0.5) / static_cast<double>(points) - 0.5;
      projection.targets[j] = projected_quantile(d, u);
    }
    projections_.push_back(std::move(projection));
  }
}

/// Returns the distance between the projection of each point and its target.
std::vector<double> WassersteinLoss::errors(const Projection& projection,
                                            const Coordinates& points) {
  const Direction d = projection.direction;
  std::vector<std::pair<double, std::uint32_t>> sorted(points.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    sorted[i] = {(points.x[i] - 0.5) * d.x + (points.y[i] - 0.5) * d.y, i};
  }
  std::ranges::sort(sorted);
  std::vector<double> errors(points.size());
  for (std::size_t j = 0; j < sorted.size(); ++j) {
    errors[sorted[j].second] = sorted[j].first - projection.targets[j];
  }
  return errors;
}

double WassersteinLoss::evaluate(const Coordinates& points, double scale,
                                 Coordinates& gradient) const {
  std::vector<std::vector<double>> all(projections_.size());
  parallel_for(all.size(), [&](std::size_t p) { all[p] = errors(projections_[p], points); });
  const auto count = static_cast<double>(points.size());
  const double weight = count / static_cast<double>(projections_.size());  // N^2 / (|A| N)
  double loss = 0;
  for (std::size_t p = 0; p < all.size(); ++p) {
    const Direction d = projections_[p].direction;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double error = all[p][i];
      loss += weight * error * error;
      gradient.x[i] += scale * 2 * weight * error * d.x;
      gradient.y[i] += scale * 2 * weight * error * d.y;
    }
  }
  return loss;
}

}  // namespace pharos::aligned
