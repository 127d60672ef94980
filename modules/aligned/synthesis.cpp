#include "synthesis.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/statistics/adam.h>

#include "coordinates.h"
#include "power_spectrum_loss.h"
#include "wasserstein_loss.h"

namespace pharos::aligned {
namespace {

/// Distinguishes this use of a seed from other uses.
constexpr std::uint64_t kStartStream = 0x616c69676e6564;

void check(const SynthesisSettings& settings) {
  if (!is_set_size(settings.points)) {
    throw InputError(fmt::format("expected a power of two of points from {} to {}, found {}",
                                 kFewestPoints, kMostPoints, settings.points));
  }
  if (settings.spectrum <= 0 && settings.wasserstein <= 0) {
    throw InputError("expected a positive weight of 'spectrum' or 'wasserstein', found none");
  }
}

Coordinates starting_points(std::uint32_t points, std::uint64_t seed) {
  const std::uint32_t rows = 1u << (std::countr_zero(points) / 2), columns = points / rows;
  Coordinates start(points);
  RandomStream random(seed, kStartStream);
  for (std::uint32_t i = 0; i < points; ++i) {
    const Vec2 u = random.next_2d();
    start.x[i] = (i % columns + static_cast<double>(u.x)) / columns;
    start.y[i] = (i / columns + static_cast<double>(u.y)) / rows;
  }
  return start;
}

/// Returns both axes and the free directions.
std::vector<Direction> all_directions(const SynthesisSettings& settings) {
  std::vector<Direction> all{direction_of(0), direction_of(90)};
  for (const double degrees : settings.directions) all.push_back(direction_of(degrees));
  return all;
}

double wasserstein_weight(const SynthesisSettings& settings) {
  constexpr double kPoints = 4096;
  return settings.wasserstein * std::min(1.0, kPoints / settings.points);
}

/// The sum of the losses with nonzero weights (eq. 10).
class TotalLoss {
 public:
  explicit TotalLoss(const SynthesisSettings& settings) : settings_(settings) {
    const std::vector<Direction> directions = all_directions(settings);
    if (settings.spectrum > 0) {
      spectrum_.emplace(settings.mask.empty()
                            ? suppressed_frequencies(settings.points, directions, settings.rule)
                            : settings.mask);
    }
    if (settings.wasserstein > 0) wasserstein_.emplace(directions, settings.points);
  }

  LossRecord evaluate(const Coordinates& points, Coordinates& gradient) const {
    LossRecord losses;
    if (spectrum_) losses.spectrum = spectrum_->evaluate(points, settings_.spectrum, gradient);
    if (wasserstein_) {
      losses.wasserstein = wasserstein_->evaluate(points, wasserstein_weight(settings_), gradient);
    }
    return losses;
  }

  std::size_t frequencies() const { return spectrum_ ? spectrum_->size() : 0; }

 private:
  const SynthesisSettings& settings_;
  std::optional<PowerSpectrumLoss> spectrum_;
  std::optional<WassersteinLoss> wasserstein_;
};

/// The points during gradient descent. The length of Adam's steps depends on the balance of the
/// losses, but not on their units.
class Descent {
 public:
  explicit Descent(const SynthesisSettings& settings)
      : points_(starting_points(settings.points, settings.seed)),
        by_x_(settings.points),
        by_y_(settings.points) {}

  const Coordinates& points() const { return points_; }

  void step(const Coordinates& gradient, double length) {
    statistics::AdamRates rates;
    rates.learning_rate = length;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      points_.x[i] = on_torus(points_.x[i] + by_x_[i].step(gradient.x[i], rates));
      points_.y[i] = on_torus(points_.y[i] + by_y_[i].step(gradient.y[i], rates));
    }
  }

 private:
  /// Wraps a coordinate around the torus: points that leave the square enter on the opposite side
  /// before projections are sorted again. Otherwise, a missing rank would shift the ranks of all
  /// other points by one.
  static double on_torus(double u) { return u - std::floor(u); }

  Coordinates points_;
  std::vector<statistics::Adam> by_x_, by_y_;
};

double step_length(const SynthesisSettings& settings, int step) {
  const double phase = std::numbers::pi * step / settings.steps;
  return settings.step / std::sqrt(settings.points) * 0.5 * (1 + std::cos(phase));
}

PointSet rounded(const Coordinates& points) {
  PointSet set;
  set.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    set.push_back(grid_point(points.x[i], points.y[i]));
  }
  return set;
}

}  // namespace

Synthesis synthesize(const SynthesisSettings& settings, const SynthesisControl& control) {
  check(settings);
  const TotalLoss loss(settings);
  Descent descent(settings);
  Synthesis result{.frequencies = loss.frequencies()};
  for (int step = 0; step < settings.steps; ++step) {
    if (control.stopped()) return result;
    if (control.on_progress) control.on_progress(static_cast<double>(step) / settings.steps);
    Coordinates gradient(settings.points);
    result.history.push_back(loss.evaluate(descent.points(), gradient));
    descent.step(gradient, step_length(settings, step));
  }
  result.points = rounded(descent.points());
  return result;
}

PointSet jittered_grid(std::uint32_t points, std::uint64_t seed) {
  return rounded(starting_points(points, seed));
}

}  // namespace pharos::aligned
