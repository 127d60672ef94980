#include "../equal_area.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/image.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

/// The inverse of equal_area_square() (Clarberg 2008).
Vec3 direction_at(Vec2 square) {
  const float u = 2 * square.x - 1, v = 2 * square.y - 1;
  const float inside = 1 - (std::abs(u) + std::abs(v)), radius = 1 - std::abs(inside);
  const float turn = radius == 0 ? 1 : (std::abs(v) - std::abs(u)) / radius + 1;
  const float azimuth = turn * kPi / 4, sine = radius * std::sqrt(2 - radius * radius);
  return {std::copysign(sine * std::cos(azimuth), u), std::copysign(sine * std::sin(azimuth), v),
          std::copysign(1 - radius * radius, inside)};
}

/// Writes a square image that shows (d + 1) / 2 in the direction d, and reads it.
LatLongImage image_of_directions(int size) {
  const test::TemporaryFolder folder;
  Image image(size, size, {"R", "G", "B"});
  const auto center = [&](int i) {
    return (static_cast<float>(i) + 0.5f) / static_cast<float>(size);
  };
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3 d = direction_at({center(x), center(y)});
      image.set_rgb(x, y, 0.5f * Rgb(1 + d.x, 1 + d.y, 1 + d.z));
    }
  }
  write_exr(image, folder / "sky.exr");
  return read_equal_area(folder / "sky.exr");
}

}  // namespace

TEST_CASE("equal area: the square covers the sphere evenly") {
  CHECK(equal_area_square({0, 0, 1}) == Vec2{0.5f, 0.5f});
  CHECK(equal_area_square({1, 0, 0}) == Vec2{1, 0.5f});
  CHECK(equal_area_square({0, 1, 0}) == Vec2{0.5f, 1});
  CHECK(equal_area_square({0, -1, 0}) == Vec2{0.5f, 0});
  RandomStream random(3);
  int left = 0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 d = warp::sphere_from_square(random.next_2d());
    const Vec2 square = equal_area_square(d);
    CHECK(length(direction_at(square) - d) < 2e-3f);
    left += square.x < 0.3f && square.y < 0.7f ? 1 : 0;
  }
  // Uniform directions are uniform in the square: 0.21 within four standard errors.
  CHECK(left / double{kCount} == doctest::Approx(0.21).epsilon(0.025));
}

TEST_CASE("equal area: an image shows what it holds, also across the edges of the square") {
  const LatLongImage image = image_of_directions(64);
  CHECK(image.height() == 64);
  CHECK(image.width() == 128);
  RandomStream random(5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = warp::sphere_from_square(random.next_2d());
    const Rgb seen = image.evaluate(LatLong::of(d));
    for (int c = 0; c < 3; ++c) {
      const float expected = 0.5f + 0.5f * (c == 0 ? d.x : c == 1 ? d.y : d.z);
      CHECK(std::abs(seen[c] - expected) < 0.03f);
    }
  }
}

TEST_CASE("equal area: an image that is not square is refused") {
  const test::TemporaryFolder folder;
  write_exr(Image(4, 2, {"R", "G", "B"}), folder / "sky.exr");
  CHECK(test::input_error_in(folder, [&] { read_equal_area(folder / "sky.exr"); }) ==
        "'sky.exr': an image in equal-area layout must be square, found 4 x 2");
}

}  // namespace pharos
