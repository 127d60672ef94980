#include "../thin_lens.h"

#include <doctest/doctest.h>

#include <pharos/config/registry.h>
#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>

#include "../perspective.h"

namespace pharos {
namespace {

Transform stretched() {
  return Transform({{{2, 0.3f, 0.1f, 1}, {0, -1.5f, 0.4f, 2}, {0.2f, 0, 0.7f, 3}}});
}

std::vector<ThinLensSensor::Settings> lenses() {
  const Transform looking = Transform::look_at({1, 2, 3}, {1, 7, 3}, {0, 0, 1});
  return {{.to_world = looking, .fov = 40, .aperture_radius = 0.15f, .focus_distance = 5.06f},
          {.to_world = looking,
           .fov = 100,
           .aperture_radius = 0.7f,
           .focus_distance = 0.5f,
           .aperture = ApertureShape::square},
          {.to_world = stretched(), .fov = 65, .aperture_radius = 0.3f, .focus_distance = 2}};
}

Vec2 inner_film(RandomStream& random) {
  return {0.001f + 0.998f * random.next_1d(), 0.001f + 0.998f * random.next_1d()};
}

TEST_CASE("all rays of a film position meet in a point of the plane of focus, the pinhole's") {
  for (const auto& settings : lenses()) {
    const auto sensor = ThinLensSensor(settings).prepare(64, 48);
    const auto pinhole =
        PerspectiveSensor({.to_world = settings.to_world, .fov = settings.fov}).prepare(64, 48);
    RandomStream random(1);
    for (int i = 0; i < 300; ++i) {
      const Vec2 film = inner_film(random);
      const Vec3 center =
          settings.to_world.inverse_vector(pinhole->ray(pinhole->sample_lens({}), film).direction);
      const Point3 focus = settings.focus_distance / center.z * center;
      for (int k = 0; k < 10; ++k) {
        const LensPoint lens = sensor->sample_lens(random.next_2d());
        const Ray ray = sensor->ray(lens, film);
        CHECK(ray.origin == lens.position);
        CHECK(length(ray.direction) == doctest::Approx(1));
        const Point3 from = settings.to_world.inverse_point(ray.origin);
        const Vec3 along = settings.to_world.inverse_vector(ray.direction);
        CHECK(std::abs(from.z) < 1e-6f);
        const Point3 met = from + settings.focus_distance / along.z * along;
        CHECK(length(met - focus) < 1e-5f * settings.focus_distance);
      }
    }
  }
}

TEST_CASE("what is not in focus is blurred by the lens's image through the plane of focus") {
  // At twice the distance the circle of confusion has the radius of the lens.
  const auto sensor =
      ThinLensSensor({.fov = 60, .aperture_radius = 0.25f, .focus_distance = 2}).prepare(10, 10);
  RandomStream random(2);
  float farthest = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = sensor->ray(sensor->sample_lens(random.next_2d()), {0.5f, 0.5f});
    const Point3 p = ray.at(4 / ray.direction.z);
    farthest = std::max(farthest, std::hypot(p.x, p.y));
  }
  CHECK(farthest <= 0.25001f);
  CHECK(farthest > 0.245f);
}

TEST_CASE("response undoes ray from every lens point") {
  for (const auto& settings : lenses()) {
    const auto sensor = ThinLensSensor(settings).prepare(64, 48);
    RandomStream random(3);
    for (int i = 0; i < 2000; ++i) {
      const Vec2 film = inner_film(random);
      const LensPoint lens = sensor->sample_lens(random.next_2d());
      const auto response = sensor->response(lens, sensor->ray(lens, film).direction);
      REQUIRE(response);
      CHECK(std::abs(response->film.x - film.x) < 1e-5f);
      CHECK(std::abs(response->film.y - film.y) < 1e-5f);
      CHECK_FALSE(sensor->response(lens, -sensor->ray(lens, film).direction));
      CHECK_FALSE(sensor->response(lens, sensor->ray(lens, {-0.01f, film.y}).direction));
      CHECK_FALSE(sensor->response(lens, sensor->ray(lens, {film.x, 1.01f}).direction));
    }
  }
}

TEST_CASE("directions of uniform film positions follow direction_pdf, which integrates to one") {
  for (const auto& settings : lenses()) {
    const auto sensor = ThinLensSensor(settings).prepare(64, 48);
    const LensPoint lens = sensor->sample_lens({0.9f, 0.2f});
    const statistics::DensityFit fit = statistics::fit_direction_density(
        [&](RandomStream& random) -> std::optional<Vec3> {
          return sensor->ray(lens, random.next_2d()).direction;
        },
        [&](Vec3 direction) -> double {
          const auto response = sensor->response(lens, direction);
          return response ? response->direction_pdf : 0;
        },
        {.draws = 60'000, .cells = 100, .quadrature_tolerance = 1e-3});
    CHECK(fit.chi_square.p_value > 1e-4);
    CHECK(fit.integral == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("direction_pdf is the density of directions, by area of small film patches") {
  constexpr float h = 1.0f / 256;
  for (const auto& settings : lenses()) {
    const auto sensor = ThinLensSensor(settings).prepare(100, 100);
    for (const Vec2 u : {Vec2{0.5f, 0.5f}, Vec2{0.05f, 0.6f}, Vec2{0.9f, 0.95f}}) {
      const LensPoint lens = sensor->sample_lens(u);
      const auto at = [&](Vec2 film) { return sensor->ray(lens, film).direction; };
      for (const Vec2 film : {Vec2{0.5f, 0.5f}, Vec2{0.1f, 0.8f}, Vec2{0.95f, 0.05f}}) {
        const Vec3 dx = at(film + Vec2{h, 0}) - at(film - Vec2{h, 0});
        const Vec3 dy = at(film + Vec2{0, h}) - at(film - Vec2{0, h});
        const float solid_angle = length(cross(dx, dy)) / (4 * h * h);
        CHECK(sensor->response(lens, at(film))->direction_pdf ==
              doctest::Approx(1 / solid_angle).epsilon(3e-3));
      }
    }
  }
}

TEST_CASE("lens points are uniform on the disk or the square") {
  constexpr int draws = 40'000, rings = 8, sectors = 8;
  for (const ApertureShape shape : {ApertureShape::round, ApertureShape::square}) {
    const auto sensor = ThinLensSensor({.aperture_radius = 0.5f, .aperture = shape}).prepare(1, 1);
    std::vector<double> seen(rings * sectors), expected(rings * sectors, draws / 64.0);
    RandomStream random(4);
    for (int i = 0; i < draws; ++i) {
      const Point3 p = 2 * sensor->sample_lens(random.next_2d()).position;
      CHECK(p.z == 0);
      const float turn = std::atan2(p.y, p.x) / (2 * kPi) + 0.5f;
      // Two coordinates in [0,1] that are uniform if the point is uniform.
      const Vec2 v = shape == ApertureShape::round ? Vec2{p.x * p.x + p.y * p.y, turn}
                                                   : Vec2{p.x / 2 + 0.5f, p.y / 2 + 0.5f};
      CHECK(std::max(v.x, v.y) <= 1.00001f);
      const auto cell = [](float x) { return static_cast<std::size_t>(std::min(x * 8, 7.0f)); };
      seen[cell(v.x) * sectors + cell(v.y)] += 1;
    }
    CHECK(statistics::chi_square_test(seen, expected).p_value > 1e-4);
  }
}

TEST_CASE("with an aperture of 0 the lens is the pinhole camera, in every bit") {
  const ThinLensSensor::Settings settings{
      .to_world = stretched(), .fov = 50, .aperture_radius = 0, .focus_distance = 3};
  const auto sensor = ThinLensSensor(settings).prepare(64, 48);
  const auto pinhole =
      PerspectiveSensor({.to_world = settings.to_world, .fov = settings.fov}).prepare(64, 48);
  RandomStream random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec2 film = random.next_2d();
    const LensPoint lens = sensor->sample_lens(random.next_2d());
    const Ray ray = sensor->ray(lens, film);
    CHECK(ray.direction == pinhole->ray(lens, film).direction);
    const auto response = sensor->response(lens, ray.direction);
    const auto expected = pinhole->response(pinhole->sample_lens({}), ray.direction);
    CHECK(ray.origin == pinhole->sample_lens({}).position);
    REQUIRE(response.has_value() == expected.has_value());
    if (!response) continue;
    CHECK(response->film == expected->film);
    CHECK(response->direction_pdf == expected->direction_pdf);
  }
}

TEST_CASE("settings that no lens can have are refused") {
  Registry registry;
  registry.add<ThinLensSensor>("thin_lens", "");
  const auto message = [&](const std::string& settings) -> std::string {
    BuildContext context{registry};
    ConfigNode resolved;
    try {
      registry.build<Sensor>(parse_yaml("{ type: thin_lens, " + settings + " }", "a.yaml"), context,
                             resolved);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message("aperture: square, aperture_radius: 0") == "");
  CHECK(message("aperture_radius: -0.1").find("aperture_radius must be >= 0") != std::string::npos);
  CHECK(message("focus_distance: 0").find("focus_distance must be >= ") != std::string::npos);
  CHECK(message("fov: 180").find("fov must be") != std::string::npos);
  CHECK(message("aperture: rond").find("did you mean 'round'?") != std::string::npos);
}

}  // namespace
}  // namespace pharos
