// thin_lens: a camera with an ideal thin lens (Kolb, Mitchell and Hanrahan 1995, "A Realistic
// Camera Model for Computer Graphics", sec. 2). It looks in the same direction as `perspective`.
// Rays of a film position start anywhere on the lens, in the local plane z = 0. They meet where the
// pinhole camera's ray crosses the plane of focus, local z = `focus_distance`. Objects in this
// plane are sharp. From a lens point l, the ray of a film position with slopes s has the
// slopes s - l / focus_distance.
//
// The lens is a disk or a square. `aperture_radius` is the radius of the disk or half the edge of
// the square, along local x and y. With an aperture of 0 it is the pinhole camera. Both lengths are
// in local space: if `to_world` scales, they scale with it.
//
//     type: thin_lens
//     to_world: { look_at: { origin: [0, 1.6, 5], target: [0, 0.8, 0], up: [0, 1, 0] } }
//     fov: 40
//     aperture_radius: 0.15
//     focus_distance: 5.06

#include "thin_lens.h"

#include <pharos/core/warp.h>
#include <pharos/scene/reach.h>

#include "view_cone.h"

namespace pharos {
namespace {

class PreparedThinLens : public PreparedSensor {
 public:
  PreparedThinLens(const ThinLensSensor::Settings& settings, float aspect)
      : settings_(settings), cone_(settings.to_world, settings.fov, aspect) {}

  LensPoint sample_lens(Vec2 u) const override {
    const bool round = settings_.aperture == ApertureShape::round;
    const Vec2 unit = round ? warp::disk_from_square(u) : Vec2{2 * u.x - 1, 2 * u.y - 1};
    return cone_.lens_point(settings_.aperture_radius * unit);
  }

  Ray ray(const LensPoint& lens, Vec2 film) const override {
    return {lens.position, cone_.direction(film, shift(lens))};
  }

  std::optional<SensorResponse> response(const LensPoint& lens, Vec3 direction) const override {
    return cone_.response(direction, shift(lens));
  }

 private:
  /// Returns the difference between the slopes of directions from the lens center and from this
  /// lens point.
  Vec2 shift(const LensPoint& lens) const {
    if (settings_.aperture_radius == 0) return {};
    const Point3 local = settings_.to_world.inverse_point(lens.position);
    return {local.x / settings_.focus_distance, local.y / settings_.focus_distance};
  }

  ThinLensSensor::Settings settings_;
  ViewCone cone_;
};

}  // namespace

void ThinLensSensor::Settings::describe(Schema<Settings>& s) {
  s.field("to_world", &Settings::to_world, "From the camera's space to world space");
  s.field("fov", &Settings::fov, "Field of view across the width")
      .unit("degrees")
      .above(0)
      .below(180);
  s.field("aperture_radius", &Settings::aperture_radius,
          "Radius of the lens, or half the edge of a square one; 0 is a pinhole")
      .unit("scene units")
      .at_least(0)
      .at_most(kFarthest);
  s.field("focus_distance", &Settings::focus_distance,
          "Distance from the lens to the plane of focus, along the view direction")
      .unit("scene units")
      .at_least(1 / kFarthest)
      .at_most(kFarthest);
  s.field("aperture", &Settings::aperture, "Shape of the lens and of points out of focus");
  s.example("{ fov: 40, aperture_radius: 0.15, focus_distance: 5 }");
  s.example("{ fov: 90, aperture_radius: 0.5, focus_distance: 0.7, aperture: square }");
  s.example("{ aperture_radius: 0 }");
}

std::unique_ptr<const PreparedSensor> ThinLensSensor::prepare(int width, int height) const {
  return std::make_unique<const PreparedThinLens>(
      settings_, static_cast<float>(width) / static_cast<float>(height));
}

}  // namespace pharos
