#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/ray.h>
#include <pharos/experiments/pictures/color_map.h>

namespace pharos {
namespace {

void check_near(Rgb found, Rgb encoded, double tolerance) {
  CHECK(std::abs(srgb_from_linear(found.r) - encoded.r) < tolerance);
  CHECK(std::abs(srgb_from_linear(found.g) - encoded.g) < tolerance);
  CHECK(std::abs(srgb_from_linear(found.b) - encoded.b) < tolerance);
}

Image row(std::initializer_list<float> values) {
  Image image(static_cast<int>(values.size()), 1, {"Y"});
  std::copy(values.begin(), values.end(), image.values().begin());
  return image;
}

}  // namespace

TEST_CASE("magma: the published colors, also between its points") {
  check_near(magma(0), {0.001462f, 0.000466f, 0.013866f}, 1e-5);
  check_near(magma(1), {0.987053f, 0.991438f, 0.749504f}, 1e-5);
  check_near(magma(17 / 255.0), {0.043830f, 0.033830f, 0.141886f}, 1e-5);
  check_near(magma(80 / 255.0), {0.414709f, 0.110431f, 0.504662f}, 0.01);
  check_near(magma(8 / 255.0), {0.013708f, 0.011771f, 0.068667f}, 0.01);
  check_near(magma(-1), {0.001462f, 0.000466f, 0.013866f}, 1e-5);
  check_near(magma(7), {0.987053f, 0.991438f, 0.749504f}, 1e-5);
}

TEST_CASE("magma: brighter step by step") {
  double last = -1;
  for (int i = 0; i <= 400; ++i) {
    const double now = luminance(magma(i / 400.0));
    CHECK(now > last);
    last = now;
  }
}

TEST_CASE("false colors: linear and logarithmic scales") {
  const Image linear = false_color(row({2, 3, 4, 5}), {.low = 2, .high = 4});
  CHECK(linear.rgb(0, 0) == magma(0));
  CHECK(linear.rgb(1, 0) == magma(0.5));
  CHECK(linear.rgb(2, 0) == magma(1));
  CHECK(linear.rgb(3, 0) == magma(1));
  const Image logarithmic =
      false_color(row({1, 10, 100, 0, -1}), {.low = 1, .high = 100, .logarithmic = true});
  CHECK(logarithmic.rgb(0, 0) == magma(0));
  CHECK(luminance(logarithmic.rgb(1, 0)) == doctest::Approx(luminance(magma(0.5))));
  CHECK(logarithmic.rgb(2, 0) == magma(1));
  CHECK(logarithmic.rgb(3, 0) == magma(0));
  CHECK(logarithmic.rgb(4, 0) == magma(0));
}

TEST_CASE("false colors: NaN stands out") {
  const Image image =
      false_color(row({std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity}), {});
  CHECK(image.rgb(0, 0) == kNanColor);
  CHECK(image.rgb(1, 0) == magma(1));
  CHECK(image.rgb(2, 0) == magma(0));
  for (int i = 0; i <= 100; ++i) {
    const Rgb d = magma(i / 100.0) - kNanColor;
    CHECK(std::abs(d.r) + std::abs(d.g) + std::abs(d.b) > 0.7);
  }
}

TEST_CASE("false colors: scales that make no sense") {
  const Image image = row({1});
  CHECK_THROWS_AS(false_color(image, {.low = 1, .high = 1}), InputError);
  CHECK_THROWS_AS(false_color(image, {.low = 2, .high = 1}), InputError);
  CHECK_THROWS_AS(false_color(image, {.low = 0, .high = 1, .logarithmic = true}), InputError);
  CHECK_THROWS_AS(false_color(image, {.low = 0, .high = std::numeric_limits<double>::infinity()}),
                  InputError);
  CHECK_THROWS_AS(false_color(image, {.low = std::nan(""), .high = 1}), InputError);
}

}  // namespace pharos
