#include <fmt/format.h>

#include <pharos/experiments/pictures/density_pictures.h>
#include <pharos/experiments/pictures/density_slice.h>

namespace pharos {
namespace {

/// The longer edge of a slice, and the height of a picture over directions [pixels].
constexpr int kEdge = 192;

DensityPicture slice(const GuidingModel& model, const Bounds3& bounds, int axis) {
  const float value = bounds.center()[axis];
  const SlicePlane plane = slice_plane(bounds, axis, value, kEdge);
  return {.name = fmt::format("slice-{}", kAxisNames[axis]),
          .caption =
              fmt::format("density, {} = {:.4g}, {}", kAxisNames[axis], value, plane.orientation()),
          .image = density_slice(model, plane)};
}

}  // namespace

std::vector<DensityPicture> density_pictures(const GuidingModel& model, const Scene& scene,
                                             int width, int height) {
  std::vector<DensityPicture> pictures;
  for (int axis = 0; axis < 3; ++axis) {
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
           fmt::format("density over directions at ({:.4g}, {:.4g}, {:.4g}), +y up", p.x, p.y, p.z),
       .image = density_directions(model, p, kEdge)});
  return pictures;
}

}  // namespace pharos
