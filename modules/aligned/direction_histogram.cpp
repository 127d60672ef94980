#include "direction_histogram.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pharos::aligned {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;

/// A separable Gaussian filter for square tiles. At borders, the part of the filter that lies
/// within the tile is normalized to a total weight of one.
class GaussianFilter {
 public:
  GaussianFilter(float sigma, int edge) : radius_(static_cast<int>(std::ceil(3 * sigma))) {
    for (int i = 0; i <= radius_; ++i) {
      const float distance = static_cast<float>(i) / sigma;
      weights_.push_back(std::exp(-0.5f * distance * distance));
    }
    for (int at = 0; at < edge; ++at) {
      float sum = 0;
      for (int i = first(at); i <= last(at, edge); ++i) sum += weight(i - at);
      scales_.push_back(1 / sum);
    }
  }

  /// Filters `in`, row by row, into `out`. `between` holds the result of the first of both steps.
  void apply(std::span<const float> in, std::span<float> between, std::span<float> out) const {
    const int edge = static_cast<int>(scales_.size());
    filter_columns(in, between, edge);
    filter_columns(between, out, edge);
  }

 private:
  int first(int at) const { return std::max(at - radius_, 0); }
  int last(int at, int edge) const { return std::min(at + radius_, edge - 1); }
  float weight(int offset) const { return weights_[static_cast<std::size_t>(std::abs(offset))]; }

  /// Filters along y and transposes the tile. Two calls make the whole filter.
  void filter_columns(std::span<const float> in, std::span<float> out, int edge) const {
    const auto width = static_cast<std::size_t>(edge);
    std::vector<float> row(width);
    for (int y = 0; y < edge; ++y) {
      std::fill(row.begin(), row.end(), 0.0f);
      for (int i = first(y); i <= last(y, edge); ++i) {
        const float w = weight(i - y) * scales_[static_cast<std::size_t>(y)];
        const float* from = in.data() + static_cast<std::size_t>(i) * width;
        for (std::size_t x = 0; x < width; ++x) row[x] += w * from[x];
      }
      for (std::size_t x = 0; x < width; ++x) out[x * width + static_cast<std::size_t>(y)] = row[x];
    }
  }

  int radius_;
  std::vector<float> weights_;  ///< by distance from the center [cells]
  std::vector<float> scales_;   ///< by position along an axis: normalization of the weights
};

/// Returns Sobel's estimate of the gradient [value / cell] at a cell that does not lie at the
/// border.
Vec2 sobel(const float* cell, std::ptrdiff_t row) {
  const float *above = cell + row, *below = cell - row;
  return {((above[1] - above[-1]) + 2 * (cell[1] - cell[-1]) + (below[1] - below[-1])) / 8,
          ((above[-1] - below[-1]) + 2 * (above[0] - below[0]) + (above[1] - below[1])) / 8};
}

void add_gradients(std::span<const float> tile, int edge, int margin, float least_length,
                   DirectionHistogram& histogram) {
  for (int y = margin; y < edge - margin; ++y) {
    for (int x = margin; x < edge - margin; ++x) {
      const Vec2 g = sobel(tile.data() + static_cast<std::ptrdiff_t>(y) * edge + x, edge);
      const double length = std::hypot(double{g.x}, double{g.y});
      if (!(length >= least_length)) continue;
      const double degrees = std::atan2(double{g.y}, double{g.x}) * (180 / kPiDouble);
      const int direction = as_direction(static_cast<int>(std::lround(degrees)));
      histogram[static_cast<std::size_t>(direction)] += length;
    }
  }
}

}  // namespace

DirectionHistogram direction_histogram(std::span<const float> values, const ProbeGrid& grid,
                                       const EdgeSettings& settings) {
  const int edge = grid.tile_edge();
  const std::size_t size = grid.tile_size();
  const GaussianFilter filter(settings.sigma, edge);
  std::vector<float> smooth(values.size()), between(size);
  for (std::size_t i = 0; i < values.size(); i += size) {
    filter.apply(values.subspan(i, size), between, std::span(smooth).subspan(i, size));
  }
  DirectionHistogram histogram{};
  constexpr float kRounding = 1e-4f;  // of filtered values, relative to the largest value
  const auto [low, high] = std::minmax_element(smooth.begin(), smooth.end());
  const float range = *high - *low;
  if (!(range > kRounding * std::max(std::abs(*low), std::abs(*high)))) return histogram;
  // The slope of a filtered step of height one [1 / cell].
  const auto step_slope = static_cast<float>(1 / (std::sqrt(2 * kPiDouble) * settings.sigma));
  const int margin = std::max(1, static_cast<int>(std::ceil(settings.sigma)));
  for (std::size_t i = 0; i < smooth.size(); i += size) {
    add_gradients(std::span(smooth).subspan(i, size), edge, margin,
                  settings.least_step * range * step_slope, histogram);
  }
  return histogram;
}

}  // namespace pharos::aligned
