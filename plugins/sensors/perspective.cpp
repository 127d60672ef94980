// perspective: a pinhole camera at the local origin. It looks along local +z. Local +y points up
// and, since the frame is right-handed, local +x points to the left. `fov` is the angle between the
// left and the right edge of the film; the film's height follows from the number of pixels.
//
//     type: perspective
//     to_world: { look_at: { origin: [0, -5, 1], target: [0, 0, 1], up: [0, 0, 1] } }
//     fov: 40

#include "perspective.h"

#include "view_cone.h"

namespace pharos {
namespace {

class PreparedPerspective : public PreparedSensor {
 public:
  PreparedPerspective(const Transform& to_world, float fov, float aspect)
      : cone_(to_world, fov, aspect), lens_(cone_.lens_point({})) {}

  LensPoint sample_lens(Vec2) const override { return lens_; }

  Ray ray(const LensPoint& lens, Vec2 film) const override {
    return {lens.position, cone_.direction(film, {})};
  }

  std::optional<SensorResponse> response(const LensPoint&, Vec3 direction) const override {
    return cone_.response(direction, {});
  }

 private:
  ViewCone cone_;
  LensPoint lens_;
};

}  // namespace

void PerspectiveSensor::Settings::describe(Schema<Settings>& s) {
  s.field("to_world", &Settings::to_world, "From the camera's space to world space");
  s.field("fov", &Settings::fov, "Field of view across the width")
      .unit("degrees")
      .above(0)
      .below(180);
  s.example("{ fov: 5 }");
  s.example(
      "{ fov: 120, to_world: { look_at: { origin: [1, 2, 3], target: [0, 0, 0], "
      "up: [0, 0, 1] } } }");
}

std::unique_ptr<const PreparedSensor> PerspectiveSensor::prepare(int width, int height) const {
  return std::make_unique<const PreparedPerspective>(
      settings_.to_world, settings_.fov, static_cast<float>(width) / static_cast<float>(height));
}

}  // namespace pharos
