#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include <pharos/core/parallel.h>
#include <pharos/experiments/pictures/density_slice.h>

namespace pharos {
namespace {

/// The largest ratio of the values of the brightest and the darkest color.
constexpr float kDecades = 1e6f;

/// The brightest color begins where the densest pixels hold the first share of the sum of all
/// pixels, and the darkest color where they hold the second share.
constexpr double kBrightestShare = 0.01, kDarkestShare = 0.999;

/// The axes of a slice along its rows and along its columns.
struct SliceAxes {
  int row, column;
  bool upwards;  ///< whether the columns' axis points up instead of down
};
constexpr SliceAxes kSliceAxes[3] = {{2, 1, true}, {0, 2, false}, {0, 1, true}};

/// Returns an image of `value(u, v)` at pixel centers.
template <class Value>
Image image_of(int width, int height, const Value& value) {
  Image image(width, height, {"Y"});
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
      *image.pixel(x, y) = static_cast<float>(value(u, v));
    }
  });
  return image;
}

}  // namespace

std::string SlicePlane::orientation() const {
  const SliceAxes& axes = kSliceAxes[axis];
  return fmt::format("{} to the right, {} {}", kAxisNames[axes.row], kAxisNames[axes.column],
                     axes.upwards ? "up" : "down");
}

SlicePlane slice_plane(const Bounds3& bounds, int axis, float value, int size) {
  const SliceAxes& axes = kSliceAxes[axis];
  const Vec3 extent = bounds.extent();
  const float longer = std::max(extent[axes.row], extent[axes.column]);
  const auto pixels = [&](float length) {
    const float share = longer > 0 ? length / longer : 1;
    return std::max(1, static_cast<int>(std::lround(static_cast<float>(size) * share)));
  };
  SlicePlane plane{bounds.low, {}, {}, pixels(extent[axes.row]), pixels(extent[axes.column]), axis};
  plane.corner[axis] = value;
  plane.right[axes.row] = extent[axes.row];
  plane.down[axes.column] = extent[axes.column];
  if (axes.upwards) {
    plane.corner[axes.column] = bounds.high[axes.column];
    plane.down = -plane.down;
  }
  return plane;
}

Image density_slice(const GuidingModel& model, const SlicePlane& plane) {
  return image_of(plane.width, plane.height,
                  [&](float u, float v) { return model.density(plane.at(u, v)); });
}

Vec3 latlong_direction(float u, float v) {
  const float azimuth = 2 * kPi * u, polar = kPi * v;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar),
          -std::sin(polar) * std::cos(azimuth)};
}

Image density_directions(const GuidingModel& model, Point3 point, int height) {
  return image_of(2 * height, height, [&](float u, float v) {
    const Vec3 direction = latlong_direction(u, v);
    return model.density(point, &direction);
  });
}

ColorScale density_scale(const Image& map) {
  std::vector<float> densities;
  std::copy_if(map.values().begin(), map.values().end(), std::back_inserter(densities),
               [](float value) { return value > 0 && std::isfinite(value); });
  if (densities.empty()) return {};
  std::sort(densities.begin(), densities.end(), std::greater<>());
  const double total = std::accumulate(densities.begin(), densities.end(), 0.0);
  const auto density_at = [&](double share) {
    double sum = 0;
    const auto last = std::find_if(densities.begin(), densities.end() - 1,
                                   [&](float value) { return (sum += value) >= share * total; });
    return *last;
  };
  const float high = density_at(kBrightestShare);
  const float low = std::max(density_at(kDarkestShare), high / kDecades);
  // A map with one single value gets the brightest color.
  return {.low = low < high ? low : high / 10, .high = high, .logarithmic = true};
}

PixelPosition densest_pixel(const Image& map) {
  PixelPosition densest;
  float largest = -kInfinity;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const float density = *map.pixel(x, y);
      if (!std::isfinite(density) || density <= largest) continue;
      largest = density;
      densest = {x, y};
    }
  }
  return densest;
}

void draw_ring(Image& colors, PixelPosition middle) {
  constexpr Rgb kColor{0, 0.8f, 1};  // magma, the map of colors, has no blue as bright as this
  constexpr float kHalfWidth = 1.5f;
  const auto edge = static_cast<float>(std::max(colors.width(), colors.height()));
  const float radius = std::max(4.0f, edge / 40);
  for (int y = 0; y < colors.height(); ++y) {
    for (int x = 0; x < colors.width(); ++x) {
      const auto dx = static_cast<float>(x - middle.x), dy = static_cast<float>(y - middle.y);
      if (std::abs(std::hypot(dx, dy) - radius) < kHalfWidth) colors.set_rgb(x, y, kColor);
    }
  }
}

}  // namespace pharos
