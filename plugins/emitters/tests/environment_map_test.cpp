#include "../environment_map.h"

#include <filesystem>
#include <functional>
#include <string>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/image.h>
#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>
#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

EnvironmentMap map_of(const Image& image, EnvironmentMap::Settings settings) {
  const test::TemporaryFolder folder;
  settings.file = folder / "sky.exr";
  write_exr(image, settings.file);
  return EnvironmentMap(settings);
}

Image image_of(int width, int height, const std::function<Rgb(int, int)>& color) {
  Image image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, color(x, y));
  }
  return image;
}

/// Independent colors between `low` and `high`.
Image noise(int width, int height, float low, float high) {
  RandomStream random(7);
  return image_of(width, height, [&](int, int) {
    const auto channel = [&] { return lerp(low, high, random.next_1d()); };
    return Rgb(channel(), channel(), channel());
  });
}

/// Noise below the horizon, a dim sky above it, and a sun of one pixel.
Image sunny(int width, int height) {
  Image image = image_of(
      width, height, [&](int, int y) { return 2 * y < height ? Rgb(0.3f, 0.4f, 0.8f) : Rgb(); });
  image.set_rgb(width / 3, height / 4, Rgb(3e4f));
  return image;
}

struct Sky {
  EnvironmentMap emitter;
  std::unique_ptr<const Light> light;

  explicit Sky(const Image& image, const Transform& to_world = {}, float scale = 1)
      : emitter(map_of(image, {.to_world = to_world, .scale = scale})),
        light(emitter.place({.scene_center = {5, 0, 0}, .scene_radius = 2})) {}

  float red(Vec3 direction) const { return light->environment_radiance(normalize(direction)).r; }
};

statistics::DensityFit fit(const Light& sampled, const Light& claimed) {
  return statistics::fit_direction_density(
      [&](RandomStream& random) -> std::optional<Vec3> {
        return sampled.sample({}, random.next_2d()).direction;
      },
      [&](Vec3 direction) -> double { return claimed.pdf_direction(direction); },
      {.draws = 60'000, .cells = 100, .quadrature_tolerance = 3e-4});
}

}  // namespace

TEST_CASE("environment_map: where the image is seen") {
  // The image has ten by five pixels: columns 2 and 7 are centered on u = 1/4 and 3/4, row 2 on the
  // horizon.
  const auto lit = [](auto&& is_lit) {
    return Sky(image_of(10, 5, [&](int x, int y) { return Rgb(is_lit(x, y) ? 1.0f : 0.0f); }));
  };
  CHECK(lit([](int x, int y) { return x == 2 && y == 2; }).red({1, 0, 0}) == doctest::Approx(1));
  CHECK(lit([](int x, int y) { return x == 7 && y == 2; }).red({-1, 0, 0}) == doctest::Approx(1));
  CHECK(lit([](int x, int) { return x == 4 || x == 5; }).red({0, 0, 1}) == doctest::Approx(1));
  CHECK(lit([](int x, int) { return x == 9 || x == 0; }).red({0, 0, -1}) == doctest::Approx(1));
  CHECK(lit([](int, int y) { return y == 0; }).red({0, 1, 0}) == 1);
  CHECK(lit([](int, int y) { return y == 4; }).red({0, -1, 0}) == 1);
  CHECK(lit([](int x, int) { return x == 2; }).red({-1, 0, 0}) == 0);
}

TEST_CASE("environment_map: to_world turns the map") {
  const Image top = image_of(10, 5, [](int x, int y) { return Rgb(y == 0, x == 2, 0); });
  const Sky z_up(top, Transform::rotate({1, 0, 0}, 90) * Transform::scale({3, 3, 3}));
  CHECK(z_up.red({0, 0, 1}) == doctest::Approx(1));
  CHECK(z_up.red({0, 1, 0}) == 0);
  CHECK(z_up.light->environment_radiance({1, 0, 0}).g == doctest::Approx(1));
  const Sky mirrored(top, Transform::scale({-1, 1, 1}));
  CHECK(mirrored.light->environment_radiance({-1, 0, 0}).g == doctest::Approx(1));
}

TEST_CASE("environment_map: bilinear, around in u and up to the edge in v") {
  const Sky sky(image_of(4, 2, [](int x, int y) { return Rgb(static_cast<float>(4 * y + x)); }), {},
                2);
  const auto at = [&](float u, float v) {
    const float theta = kPi * v, phi = 2 * kPi * u;
    return sky.red(
        {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
  };
  CHECK(at(0.375f, 0.25f) == doctest::Approx(2 * 1));
  CHECK(at(0.4375f, 0.25f) == doctest::Approx(2 * 1.25));
  CHECK(at(0.375f, 0.5f) == doctest::Approx(2 * 3));
  CHECK(at(0.375f, 0.1f) == doctest::Approx(2 * 1));
  CHECK(at(0.375f, 0.9f) == doctest::Approx(2 * 5));
  CHECK(at(0, 0.25f) == doctest::Approx(2 * 1.5));  // between the last column and the first
  CHECK(at(0.9999f, 0.75f) == doctest::Approx(2 * 5.5).epsilon(1e-3));
}

TEST_CASE("environment_map: directions follow the density that is claimed for them") {
  const Image poles = image_of(6, 4, [](int x, int y) { return Rgb(y % 3 == 0 && x == 2); });
  for (const Image& image :
       {noise(12, 6, 0, 1), sunny(64, 32), poles, noise(1, 1, 1, 1), noise(2, 1, 0, 1)}) {
    CAPTURE(image.width());
    const Sky sky(image, Transform::rotate({1, 2, 3}, 50));
    const auto found = fit(*sky.light, *sky.light);
    CHECK(found.chi_square.p_value > 1e-4);
    CHECK(found.integral == doctest::Approx(1).epsilon(2e-3));
    CHECK(found.missed == 0);
    CHECK(found.outside_support == 0);
  }
  // The same test detects a sun that is a quarter of a pixel off.
  const Sky sky(sunny(64, 32)), turned(sunny(64, 32), Transform::rotate({0, 1, 0}, 1.4f));
  CHECK(fit(*sky.light, *turned.light).chi_square.p_value < 1e-6);
}

TEST_CASE("environment_map: samples carry the radiance and density of rays that leave the scene") {
  const Sky sky(sunny(32, 16), Transform::rotate({1, 0, 0}, 90), 3);
  RandomStream random(1);
  for (int i = 0; i < 2000; ++i) {
    const Point3 from{10 * random.next_1d(), 0, -3};
    const LightSample s = sky.light->sample(from, random.next_2d());
    CHECK(s.radiance == sky.light->environment_radiance(s.direction));
    CHECK(s.pdf == sky.light->pdf_direction(s.direction));
    CHECK(s.pdf > 0);
    CHECK_FALSE(s.discrete);
    CHECK(s.kind == VertexKind::environment);
    CHECK(s.distance == kInfinity);
    CHECK(length(s.direction) == doctest::Approx(1));
    CHECK(length(s.point.position - Point3{5, 0, 0}) > 2);
  }
  CHECK(sky.light->is_environment());
  CHECK_FALSE(sky.emitter.needs_shape());
}

TEST_CASE("environment_map: the density is near to radiance, and nothing that shines is missed") {
  const Sky sky(image_of(16, 8, [](int x, int y) { return Rgb((x * 5 + y * 3) % 7 == 0); }));
  const double integral = sky.light->power() / (kPi * 4);
  RandomStream random(3);
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 d = LatLong::direction(random.next_1d(), random.next_1d());
    const double share = mean(sky.light->environment_radiance(d)) / integral;
    const double pdf = sky.light->pdf_direction(d);
    if (share < 1e-5) continue;
    CHECK(pdf > 0.5 * share);
    CHECK(pdf < 1.5001 * share);
  }
}

TEST_CASE("environment_map: power is that of all radiance through the scene's disk") {
  for (const Image& image : {noise(32, 16, 0, 2), sunny(64, 32)}) {
    const Sky sky(image, {}, 2);
    const auto radiance = [&](Vec3 d) -> double {
      return mean(sky.light->environment_radiance(d));
    };
    const double exact = statistics::integrate_sphere(radiance, {.tolerance = 1e-2}, 64, 64).value;
    CHECK(sky.light->power() == doctest::Approx(kPi * 4 * exact).epsilon(5e-3));
  }
}

TEST_CASE("environment_map: the estimate of irradiance is exact in large maps") {
  // A sun of one pixel next to the pole holds most of the light.
  Image image = noise(2048, 1024, 1, 1);
  image.set_rgb(100, 2, Rgb(1e9f));
  const Sky sky(image);
  double sum = 0;
  constexpr int count = 256;
  for (int i = 0; i < count * count; ++i) {
    const Vec2 u{(i % count + 0.5f) / count, (i / count + 0.5f) / count};
    const LightSample s = sky.light->sample({}, u);
    sum += double{s.radiance.r} / s.pdf / (count * count);
  }
  // The integral of the bilinear hat of width w in longitude and polar angle is w^2 sin(angle)
  // sinc^2(w / 2).
  const double w = 3.14159265358979 / 1024, angle = 2.5 * w;
  CHECK(sum == doctest::Approx(4 * kPi + 1e9 * w * w * std::sin(angle)).epsilon(1e-3));
}

TEST_CASE("environment_map: near primary numbers make near directions") {
  const Sky sky(noise(16, 8, 1, 2));
  constexpr float step = 1e-3f;
  for (float x = 0; x < 1 - step; x += 0.01f) {
    for (float y = 0.05f; y < 0.95f; y += 0.01f) {
      const Vec3 d = sky.light->sample({}, {x, y}).direction;
      // The density is nowhere below half the mean, so a step in u is at most twice as long as on
      // average. A step in y also shears the columns.
      CHECK(length(sky.light->sample({}, {x + step, y}).direction - d) < 2 * 2 * kPi * step);
      CHECK(length(sky.light->sample({}, {x, y + step}).direction - d) < 12 * step);
    }
  }
}

TEST_CASE("environment_map: a black map is never sampled") {
  const Sky sky(noise(4, 2, 0, 0));
  CHECK(sky.light->sample({}, {0.5f, 0.5f}).pdf == 0);
  CHECK(sky.light->pdf_direction({0, 1, 0}) == 0);
  CHECK(sky.light->power() == 0);
}

TEST_CASE("environment_map: black rows, sampled at the ends of the primary numbers") {
  for (const unsigned lit : {1u, 2u, 4u, 8u, 9u, 6u, 5u, 15u}) {
    for (const int column : {-1, 0, 7}) {  // -1: all columns
      const Sky sky(image_of(8, 4, [&](int x, int y) {
        return Rgb((lit >> y & 1) != 0 && (column < 0 || x == column));
      }));
      for (const float x : {0.0f, 0.5f, kOneMinusEpsilon}) {
        for (const float y : {0.0f, 0.5f, kOneMinusEpsilon}) {
          CAPTURE(lit);
          const LightSample s = sky.light->sample({}, {x, y});
          CHECK(std::isfinite(s.pdf));
          if (s.pdf > 0) CHECK(length(s.direction) == doctest::Approx(1));
        }
      }
      CHECK(sky.light->sample({}, {0.3f, 0.2f}).pdf > 0);
    }
  }
  const Sky sky(noise(8, 4, 1, 2));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK_FALSE(sky.light->pdf_direction({nan, nan, nan}) > 0);
}

TEST_CASE("environment_map: wrong images and settings") {
  Image image = noise(4, 2, 0, 1);
  image.set_rgb(3, 1, {0, -1, 0});
  CHECK_THROWS_WITH_AS(Sky{image}, doctest::Contains("pixel (3, 1) is negative or not finite"),
                       InputError);
  image.set_rgb(3, 1, {0, 0, std::numeric_limits<float>::quiet_NaN()});
  CHECK_THROWS_WITH_AS(Sky{image}, doctest::Contains("pixel (3, 1)"), InputError);
  CHECK_THROWS_WITH_AS(Sky(noise(4, 2, 0.9e38f, 1e38f)), doctest::Contains("beyond"), InputError);
  CHECK_THROWS_WITH_AS(Sky(noise(4, 2, 0, 1), Transform::scale({1, 2, 1})),
                       doctest::Contains("scale evenly"), InputError);
  CHECK_THROWS_AS(EnvironmentMap({.file = "no-such-file.exr"}), InputError);
}

}  // namespace pharos
