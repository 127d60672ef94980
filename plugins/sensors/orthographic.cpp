// orthographic: a camera with parallel rays, for plans and elevations. Rays start in the local
// plane z = 0 and run along local +z. Local +y points up and, since the frame is right-handed,
// local +x points to the left. Objects behind the plane are not seen. `width` is the width of the
// view; its height follows from the number of pixels. If `to_world` scales, both scale with it.
//
// A film position determines where a ray starts. There is no density over directions, so a guide
// cannot choose the first vertex.
//
//     type: orthographic
//     to_world: { look_at: { origin: [0, 0, 10], target: [0, 0, 0], up: [0, 1, 0] } }
//     width: 4

#include "orthographic.h"

#include <pharos/scene/reach.h>

#include "film_window.h"

namespace pharos {
namespace {

class PreparedOrthographic : public PreparedSensor {
 public:
  PreparedOrthographic(const OrthographicSensor::Settings& settings, float aspect)
      : to_world_(settings.to_world),
        window_(settings.width / 2, aspect),
        center_{.position = to_world_.point({}), .normal = normalize(to_world_.vector({0, 0, 1}))} {
  }

  /// The center stands for all points, because each film position has its own.
  LensPoint sample_lens(Vec2) const override { return center_; }

  Ray ray(const LensPoint& lens, Vec2 film) const override {
    const Vec2 local = window_.point(film);
    return {to_world_.point({local.x, local.y, 0}), lens.normal};
  }

  std::optional<SensorResponse> response(const LensPoint&, Vec3) const override {
    return std::nullopt;
  }
  /// Rays are spread evenly over the film and run straight on from it.
  std::optional<SensorConnection> connect(Point3 from, Vec2) const override {
    const Vec3 local = to_world_.inverse_point(from);
    const std::optional<Vec2> film = window_.film({local.x, local.y});
    if (!film || !(local.z > 0)) return std::nullopt;
    const Vec3 x = to_world_.vector({1, 0, 0}), y = to_world_.vector({0, 1, 0});
    SensorConnection way{.lens = center_, .direction = -center_.normal, .film = *film};
    way.lens.position = to_world_.point({local.x, local.y, 0});
    way.distance = length(from - way.lens.position);
    way.pdf = 1 / (window_.area() * abs_dot(cross(x, y), center_.normal));
    return way;
  }

 private:
  Transform to_world_;
  FilmWindow window_;
  LensPoint center_;
};

}  // namespace

void OrthographicSensor::Settings::describe(Schema<Settings>& s) {
  s.field("to_world", &Settings::to_world, "From the camera's space to world space");
  s.field("width", &Settings::width, "Width of the view")
      .unit("scene units")
      .above(0)
      .at_most(kFarthest);
  s.example("{ width: 0.5 }");
  s.example(
      "{ width: 10, to_world: { look_at: { origin: [0, 5, 5], target: [0, 0, 0], "
      "up: [0, 1, 0] } } }");
}

std::unique_ptr<const PreparedSensor> OrthographicSensor::prepare(int width, int height) const {
  return std::make_unique<const PreparedOrthographic>(
      settings_, static_cast<float>(width) / static_cast<float>(height));
}

}  // namespace pharos
