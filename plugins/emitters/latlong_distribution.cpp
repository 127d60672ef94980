#include "latlong_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pharos/core/error.h>

namespace pharos {
namespace {

/// Returns the position in [0, 1] at which the integral of the linear density from `a` at 0 to `b`
/// at 1 reaches the share `u`. The form avoids cancellation.
double linear_from_unit(double u, double a, double b) {
  const double denominator = a + std::sqrt((1 - u) * a * a + u * b * b);
  return denominator > 0 ? std::clamp(u * (a + b) / denominator, 0.0, 1.0) : u;
}

}  // namespace

LatLongDistribution::LatLongDistribution(const LatLongImage& image) : image_(image) {
  cumulative_.reserve(index(0, image.height()));
  for (int row = 0; row < image.height(); ++row) add_row(row);
  add_bands();
  if (!std::isfinite(integral())) {
    throw InputError("the image's integral is beyond what a float can hold");
  }
}

void LatLongDistribution::add_row(int row) {
  double sum = 0;
  cumulative_.push_back(0);
  for (int column = 0; column < image_.width(); ++column) {
    sum += 0.5 *
           (mean(image_.pixel(column, row)) + mean(image_.pixel(image_.wrapped(column + 1), row)));
    cumulative_.push_back(static_cast<float>(sum));
  }
}

void LatLongDistribution::add_bands() {
  const int rows = image_.height();
  edges_.push_back(0);
  for (int row = 0; row < rows; ++row) {
    const double sine = std::sin(std::numbers::pi / 2 * (row + 0.5) / rows);
    edges_.push_back(sine * sine);
  }
  edges_.push_back(1);
  bands_.push_back(0);
  for (int band = 0; band <= rows; ++band) {
    const auto b = static_cast<std::size_t>(band);
    const double both = row_sum(image_.clamped(band - 1)) + row_sum(image_.clamped(band));
    total_ += (edges_[b + 1] - edges_[b]) * both / (2 * image_.width());
    bands_.push_back(total_);
  }
}

double LatLongDistribution::weight(int column, const Blend& rows) const {
  return rows.of(mean(image_.pixel(column, rows.upper)), mean(image_.pixel(column, rows.lower)));
}

double LatLongDistribution::cumulative(int column, const Blend& rows) const {
  return rows.of(cumulative_[index(column, rows.upper)], cumulative_[index(column, rows.lower)]);
}

std::optional<Vec3> LatLongDistribution::sample(Vec2 u) const {
  if (!(total_ > 0)) return std::nullopt;
  const double target = double{u.y} * total_;
  const auto end = std::upper_bound(bands_.begin() + 1, bands_.end() - 1, target);
  const auto b = static_cast<std::size_t>(end - bands_.begin()) - 1;
  const int upper = image_.clamped(static_cast<int>(b) - 1);
  const int lower = image_.clamped(static_cast<int>(b));
  const double share = (target - bands_[b]) / (bands_[b + 1] - bands_[b]);
  const double t = linear_from_unit(share, row_sum(upper), row_sum(lower));
  const Blend rows{upper, lower, t};
  if (!(cumulative(image_.width(), rows) > 0)) return std::nullopt;
  const double above = edges_[b] + t * (edges_[b + 1] - edges_[b]);
  return LatLong::direction(sample_column(u.x, rows), above);
}

/// Returns the coordinate u within a pair of rows that is not black.
float LatLongDistribution::sample_column(float u, const Blend& rows) const {
  const double target = double{u} * cumulative(image_.width(), rows);
  int low = 0, high = image_.width();  // cumulative(low) <= target < cumulative(high)
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (cumulative(middle, rows) <= target ? low : high) = middle;
  }
  const double start = cumulative(low, rows);
  const double share = (target - start) / (cumulative(high, rows) - start);
  const double across =
      linear_from_unit(share, weight(low, rows), weight(image_.wrapped(high), rows));
  const double coordinate = (low + 0.5 + across) / image_.width();
  return static_cast<float>(coordinate < 1 ? coordinate : coordinate - 1);
}

float LatLongDistribution::pdf(const LatLong& place) const {
  if (!(total_ > 0)) return 0;
  const PixelPair across = PixelPair::at(place.u, image_.width());
  const int band = PixelPair::at(place.v, image_.height()).low + 1;
  const auto b = static_cast<std::size_t>(band);
  const double t = (place.above - edges_[b]) / (edges_[b + 1] - edges_[b]);
  // The band was found in float, so t may lie slightly outside [0, 1].
  const Blend rows{image_.clamped(band - 1), image_.clamped(band), std::clamp(t, 0.0, 1.0)};
  const double left = weight(image_.wrapped(across.low), rows);
  const double right = weight(image_.wrapped(across.low + 1), rows);
  const double density = (1 - double{across.t}) * left + double{across.t} * right;
  return static_cast<float>(density / (4 * std::numbers::pi * total_));
}

}  // namespace pharos
