// Tests of pictures of densities: planes, directions, scales and clouds, for models with a known
// distribution of mass.

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <pharos/experiments/pictures/density_cloud.h>
#include <pharos/experiments/pictures/density_slice.h>
#include <pharos/experiments/pictures/scene_outline.h>

namespace pharos {
namespace {

/// A density that is a Gaussian ball. Over directions, it is a lobe around the direction towards
/// the center.
class BallModel final : public GuidingModel {
 public:
  explicit BallModel(Point3 center) : center_(center) {}

  ModelInfo info() const override { return {.name = "ball", .bytes = sizeof center_}; }
  void archive(Archive&) override {}
  double density(Point3 point, const Vec3* direction) const override {
    return direction == nullptr ? std::exp(-20 * length_squared(point - center_))
                                : std::exp(5 * dot(*direction, normalize(center_ - point)));
  }

 private:
  Point3 center_;
};

/// A density of 1 within a small ball and 0 elsewhere.
class PointModel final : public GuidingModel {
 public:
  PointModel(Point3 center, float radius) : center_(center), radius_(radius) {}

  ModelInfo info() const override { return {.name = "point", .bytes = sizeof center_}; }
  void archive(Archive&) override {}
  double density(Point3 point, const Vec3* direction) const override {
    return direction == nullptr && length(point - center_) < radius_ ? 1 : 0;
  }

 private:
  Point3 center_;
  float radius_;
};

/// Bounds of four units along x, two along y and one along z.
Bounds3 brick() {
  return {{-2, 0, 5}, {2, 2, 6}};
}

/// Returns the position (u, v) of the largest value.
Vec2 brightest(const Image& map) {
  Vec2 at;
  float largest = -kInfinity;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (*map.pixel(x, y) <= largest) continue;
      largest = *map.pixel(x, y);
      at = {(static_cast<float>(x) + 0.5f) / static_cast<float>(map.width()),
            (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height())};
    }
  }
  return at;
}

void check_near(Vec2 found, Vec2 expected, float tolerance) {
  CAPTURE(found.x);
  CAPTURE(found.y);
  CHECK(std::abs(found.x - expected.x) < tolerance);
  CHECK(std::abs(found.y - expected.y) < tolerance);
}

Image row(std::initializer_list<float> values) {
  Image image(static_cast<int>(values.size()), 1, {"Y"});
  std::copy(values.begin(), values.end(), image.values().begin());
  return image;
}

}  // namespace

TEST_CASE("slices: the shape of the bounds, brightest where the mass is") {
  const BallModel ball({1, 0.5f, 5.75f});
  const auto slice = [&](int axis, float value) {
    return density_slice(ball, slice_plane(brick(), axis, value, 100));
  };
  const Image x = slice(0, 1), y = slice(1, 0.5f), z = slice(2, 5.75f);
  CHECK(x.width() == 50);
  CHECK(x.height() == 100);
  check_near(brightest(x), {0.75f, 0.75f}, 0.02f);  // z to the right, y up
  CHECK(y.width() == 100);
  CHECK(y.height() == 25);
  check_near(brightest(y), {0.75f, 0.75f}, 0.03f);  // x to the right, z down
  CHECK(z.width() == 100);
  CHECK(z.height() == 50);
  check_near(brightest(z), {0.75f, 0.75f}, 0.02f);  // x to the right, y up
  CHECK(slice_plane(brick(), 0, 1, 100).orientation() == "z to the right, y up");
  CHECK(slice_plane(brick(), 1, 1, 100).orientation() == "x to the right, z down");
  // The density decreases away from the center.
  const Image away = slice(2, 5.25f);
  CHECK(*away.pixel(75, 37) == doctest::Approx(std::exp(-20 * 0.25) * *z.pixel(75, 37)));
}

TEST_CASE("directions: as environment maps are laid out") {
  const auto towards = [](Point3 center) {
    return brightest(density_directions(BallModel(center), {}, 64));
  };
  check_near(towards({0, 0, 1}), {0.5f, 0.5f}, 0.01f);
  check_near(towards({1, 0, 0}), {0.25f, 0.5f}, 0.01f);
  check_near(towards({-1, 0, 0}), {0.75f, 0.5f}, 0.01f);
  CHECK(towards({0, 1, 0}).y < 0.01f);
  CHECK(towards({0, -1, 0}).y > 0.99f);
}

TEST_CASE("scales: by percentiles of mass, six decades at most, no zeros, no NaN") {
  const ColorScale narrow = density_scale(row({0, 2, 8, 4}));
  CHECK(narrow.low == 2);
  CHECK(narrow.high == 8);
  CHECK(narrow.logarithmic);
  const ColorScale wide =
      density_scale(row({1e-20f, 100, kInfinity, std::numeric_limits<float>::quiet_NaN(), -1000}));
  CHECK(wide.low == doctest::Approx(10));
  CHECK(wide.high == 100);
  // 10,000 pixels of mass 1 and one of 50: half a percent, so that it does not set the scale.
  Image spike(100, 100, {"Y"});
  std::fill(spike.values().begin(), spike.values().end(), 1.0f);
  spike.values().front() = 50;
  spike.values().back() = 1e-3f;  // beyond 99.9 %
  CHECK(density_scale(spike).high == 1);
  spike.values().front() = 1e9f;
  CHECK(density_scale(spike).high == 1e9f);
  CHECK(density_scale(spike).low == doctest::Approx(1e8f));
  const ColorScale constant = density_scale(row({3, 3}));
  CHECK(scale_position(3, constant) == 1);
  CHECK_FALSE(density_scale(row({0, 0})).logarithmic);
}

TEST_CASE("a ring marks the densest pixel") {
  Image map(60, 30, {"Y"});
  *map.pixel(40, 11) = 2;
  *map.pixel(3, 3) = kInfinity;
  const PixelPosition densest = densest_pixel(map);
  CHECK(densest.x == 40);
  CHECK(densest.y == 11);
  Image colors(60, 30, {"R", "G", "B"});
  draw_ring(colors, densest);
  CHECK(colors.rgb(40, 11).b == 0);
  CHECK(colors.rgb(44, 11).b == 1);
  CHECK(colors.rgb(40, 7).b == 1);
  CHECK(colors.rgb(50, 11).b == 0);
}

TEST_CASE("clouds: mass shows where it is seen from the front, the right and above") {
  const auto seen = [](Point3 center) {
    return brightest(cloud_density(BallModel(center), brick(), oblique_view(brick(), 80)));
  };
  const Point3 middle = brick().center();
  check_near(seen(middle), {0.5f, 0.5f}, 0.02f);
  CHECK(seen({middle.x, 2, middle.z}).y < 0.4f);
  CHECK(seen({2, middle.y, middle.z}).x > 0.7f);
  CHECK(seen({-2, middle.y, middle.z}).x < 0.3f);
  CHECK(seen({middle.x, middle.y, 6}).x < 0.5f);  // the front is to the left of the middle
}

TEST_CASE("clouds: the largest value on a ray, and nothing outside the bounds") {
  const BallModel ball(brick().center());
  const Image map = cloud_density(ball, brick(), oblique_view(brick(), 80));
  CHECK(*map.pixel(40, 40) == doctest::Approx(1).epsilon(0.06));
  CHECK(*map.pixel(0, 0) == 0);
  CHECK(*map.pixel(79, 79) == 0);
}

TEST_CASE("clouds: nothing as large as a pixel is stepped over") {
  const CloudView view = oblique_view(brick(), 80);
  for (int i = 0; i < 10; ++i) {
    const Point3 center{-1.5f + 0.3f * static_cast<float>(i), 1.1f, 5.4f};
    const Image map = cloud_density(PointModel(center, brick().diagonal() / 80), brick(), view);
    CHECK(std::count(map.values().begin(), map.values().end(), 1.0f) > 0);
  }
}

TEST_CASE("clouds: what is dense hides the backdrop, what is not shows it") {
  Image backdrop(3, 1, {"R", "G", "B"});
  for (float& value : backdrop.values()) value = 0.25f;
  const Image picture =
      cloud_picture(row({1, 100, 10}), {.low = 1, .high = 100, .logarithmic = true}, backdrop);
  CHECK(picture.rgb(0, 0) == Rgb(0.25f));
  CHECK(picture.rgb(1, 0) == magma(1));
  // Halfway on the scale, a quarter of the color shows.
  CHECK(picture.rgb(2, 0).b == doctest::Approx(0.75 * 0.25 + magma(0.5).b / 4));
}

TEST_CASE("the box around a cloud: twelve edges, the corners where the cloud would be") {
  const Image edges = box_edges(brick(), 200);
  std::size_t lit = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) lit += edges.rgb(x, y).g > 0.1f;
  }
  CHECK(lit > 500);
  CHECK(lit < 3000);
  const Vec2 corner =
      brightest(cloud_density(BallModel(brick().high), brick(), oblique_view(brick(), 200)));
  bool is_lit = false;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      is_lit |=
          edges.rgb(static_cast<int>(corner.x * 200) + x, static_cast<int>(corner.y * 200) + y).g >
          0.2f;
    }
  }
  CHECK(is_lit);
}

TEST_CASE("lines are drawn as far as they cover a pixel") {
  Image colors(3, 1, {"R", "G", "B"});
  for (float& value : colors.values()) value = 0.2f;
  draw_over(colors, row({0, 0.5f, 1}));
  CHECK(colors.rgb(0, 0) == Rgb(0.2f));
  CHECK(colors.rgb(1, 0).g == doctest::Approx(0.6f));
  CHECK(colors.rgb(2, 0) == Rgb(1));
}

}  // namespace pharos
