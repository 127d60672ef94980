// perspective: a pinhole camera at the local origin. It looks along local +z with local +y up and,
// as the frame is right-handed, local +x to the left; `fov` is the angle between the left and the
// right edge of the film, whose height follows from the number of pixels.
//
//     type: perspective
//     to_world: { look_at: { origin: [0, -5, 1], target: [0, 0, 1], up: [0, 0, 1] } }
//     fov: 40

#include "perspective.h"

namespace pharos {
namespace {

class PreparedPerspective : public PreparedSensor {
 public:
  PreparedPerspective(const Transform& to_world, float fov, float aspect)
      : to_world_(to_world), half_width_(std::tan(radians(fov) / 2)) {
    half_height_ = half_width_ / aspect;
    const Vec3 x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0});
    const Vec3 z = to_world.vector({0, 0, 1});
    volume_ = abs_dot(cross(x, y), z);
    lens_ = {.position = to_world.point({}), .normal = normalize(z)};
  }

  LensPoint sample_lens(Vec2) const override { return lens_; }

  Ray ray(const LensPoint& lens, Vec2 film) const override {
    const Vec3 local{(1 - 2 * film.x) * half_width_, (1 - 2 * film.y) * half_height_, 1};
    return {lens.position, normalize(to_world_.vector(local))};
  }

  std::optional<SensorResponse> response(const LensPoint&, Vec3 direction) const override {
    const Vec3 local = to_world_.inverse_vector(direction);
    if (!(local.z > 0)) return std::nullopt;
    const Vec2 film{(1 - local.x / (local.z * half_width_)) / 2,
                    (1 - local.y / (local.z * half_height_)) / 2};
    if (!(film.x >= 0 && film.x < 1 && film.y >= 0 && film.y < 1)) return std::nullopt;
    // Uniform density 1/A on the film at z = 1 is |v|^3 / (A z^3) in solid angle about a local
    // direction v. A linear map of determinant D onto unit directions divides that by |v|^3 D.
    const float film_area = 4 * half_width_ * half_height_;
    return SensorResponse{film, 1 / (film_area * volume_ * local.z * local.z * local.z)};
  }

 private:
  Transform to_world_;
  float half_width_, half_height_;  ///< of the film at local z = 1
  float volume_;                    ///< |determinant| of to_world's linear part
  LensPoint lens_;
};

}  // namespace

void PerspectiveSensor::Settings::describe(Schema<Settings>& s) {
  s.field("to_world", &Settings::to_world, "From the camera's space to world space");
  s.field("fov", &Settings::fov, "Field of view across the width")
      .unit("degrees")
      .above(0)
      .below(180);
}

std::unique_ptr<const PreparedSensor> PerspectiveSensor::prepare(int width, int height) const {
  return std::make_unique<const PreparedPerspective>(
      settings_.to_world, settings_.fov, static_cast<float>(width) / static_cast<float>(height));
}

}  // namespace pharos
