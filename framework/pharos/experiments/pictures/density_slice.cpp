#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/core/parallel.h>
#include <pharos/experiments/pictures/density_slice.h>

namespace pharos {
namespace {

/// The largest ratio of the values of the brightest and the darkest color.
constexpr float kDecades = 1e6f;

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
  float low = kInfinity, high = 0;
  for (const float value : map.values()) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (high == 0) return {};
  low = std::max(low, high / kDecades);
  // A map with one single value gets the brightest color.
  return {.low = low < high ? low : high / 10, .high = high, .logarithmic = true};
}

}  // namespace pharos
