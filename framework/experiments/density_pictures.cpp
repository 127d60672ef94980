#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <pharos/core/parallel.h>
#include <pharos/experiments/density_pictures.h>

namespace pharos {
namespace {

/// Longer edge of a slice, and height of a picture over directions [pixels].
constexpr int kEdge = 192;

using Vec3Member = float Vec3::*;
constexpr std::array<Vec3Member, 3> kAxes{&Vec3::x, &Vec3::y, &Vec3::z};
constexpr std::array<char, 3> kAxisNames{'x', 'y', 'z'};

/// An image of `value(u, v)` at pixel centres, u to the right and v upwards in (0, 1).
template <class Value>
Image image_of(int width, int height, const Value& value) {
  Image image(width, height, {"Y"});
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      image.pixel(x, y)[0] = static_cast<float>(
          value((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
    }
  });
  return image;
}

DensityPicture slice(const GuidingModel& model, const Bounds3& bounds, std::size_t axis) {
  const Vec3Member right = kAxes[(axis + 1) % 3], up = kAxes[(axis + 2) % 3];
  const Vec3 extent = bounds.extent();
  const float longer = std::max(extent.*right, extent.*up);
  const auto pixels = [&](float length) {
    return std::max(1, static_cast<int>(std::lround(kEdge * length / longer)));
  };
  const auto value = [&](float u, float v) {
    Point3 point = bounds.center();
    point.*right = bounds.low.*right + u * extent.*right;
    point.*up = bounds.low.*up + v * extent.*up;
    return model.density(point);
  };
  return {.name = fmt::format("slice-{}", kAxisNames[axis]),
          .caption = fmt::format("density, {} = {:.4g}, {} to the right, {} up", kAxisNames[axis],
                                 bounds.center().*kAxes[axis], kAxisNames[(axis + 1) % 3],
                                 kAxisNames[(axis + 2) % 3]),
          .image = image_of(pixels(extent.*right), pixels(extent.*up), value)};
}

Vec3 direction_at(float u, float v) {
  const float azimuth = 2 * std::numbers::pi_v<float> * u,
              polar = std::numbers::pi_v<float> * (1 - v);
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}

}  // namespace

std::vector<DensityPicture> density_pictures(const GuidingModel& model, const Scene& scene,
                                             int width, int height) {
  std::vector<DensityPicture> pictures;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    pictures.push_back(slice(model, scene.bounds(), axis));
  }
  const auto sensor = scene.sensor().prepare(width, height);
  SurfacePoint point;
  const Ray ray = sensor->ray(sensor->sample_lens({0.5f, 0.5f}), {0.5f, 0.5f});
  if (scene.intersect(ray, point) == kInfinity) return pictures;
  const Point3 p = point.position;
  pictures.push_back(
      {.name = "directions",
       .caption =
           fmt::format("density over directions at ({:.4g}, {:.4g}, {:.4g}), +z up", p.x, p.y, p.z),
       .image = image_of(2 * kEdge, kEdge,
                         [&](float u, float v) { return model.density(p, direction_at(u, v)); })});
  return pictures;
}

}  // namespace pharos
