#include "../picture.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "../canvas.h"

namespace pharos::focal::plane {
namespace {

constexpr Rgb kWhite{1, 1, 1}, kBlack{0, 0, 0};

/// Returns the amount of ink, in pixels of full black.
double ink_on(const Canvas& canvas) {
  double sum = 0;
  const Image image = canvas.image();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += 1 - srgb_from_linear(image.rgb(x, y).g);
  }
  return sum;
}

/// Returns the sum of the pixel values of a picture with one path of the given value.
double brightness(double value) {
  const Panel panels[] = {{.title = "(a)",
                           .paths = {{.x = 0.5, .angle = -0.4, .pdf = 1, .value = value}},
                           .variances = {0.01, 0.02, 0.015},
                           .color = {0.8f, 0.3f, 0.1f}}};
  const std::vector<double> uniform(64, 0.1);
  const Image image = draw_picture({}, panels, uniform, 2);
  double sum = 0;
  for (const float v : image.values()) sum += v;
  return sum;
}

}  // namespace

TEST_CASE("canvas: a rectangle covers its area, parts of pixels in part") {
  Canvas canvas(20, 20, kWhite);
  canvas.rectangle({2.25, 3.5}, {10.5, 12.75}, {kBlack, 0.5});
  CHECK(ink_on(canvas) == doctest::Approx(0.5 * 8.25 * 9.25).epsilon(1e-4));
}

TEST_CASE("canvas: a line has the ink of its length times its width, at any slope") {
  for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0, 160.0}) {
    CAPTURE(degrees);
    Canvas canvas(240, 240, kWhite);
    const double angle = degrees * 3.14159265 / 180;
    const double dx = 100 * std::cos(angle), dy = 100 * std::sin(angle);
    canvas.line({120.3 - dx, 120.3 - dy}, {120.3 + dx, 120.3 + dy}, 2, {kBlack, 0.5});
    CHECK(ink_on(canvas) == doctest::Approx(0.5 * 200 * 2).epsilon(0.03));
  }
}

TEST_CASE("canvas: what lies outside is cut off") {
  Canvas canvas(10, 10, kWhite);
  canvas.line({-50, 5}, {50, 5}, 1, {kBlack});
  canvas.rectangle({-5, -5}, {2, 2}, {kBlack});
  CHECK(ink_on(canvas) == doctest::Approx(14).epsilon(0.01));
}

TEST_CASE("canvas: text is as wide as said, and letters that the font lacks are errors") {
  Canvas canvas(200, 40, kWhite);
  CHECK(canvas.text({5, 30}, "ab 1", 20, {kBlack}) == doctest::Approx(text_width("ab 1", 20)));
  CHECK(text_width("ab", 20) == doctest::Approx(2 * text_width("a", 20)));
  CHECK(ink_on(canvas) > 100);
  CHECK(text_width("0123456789-", 20) > text_width("123", 20));
  CHECK_THROWS_WITH_AS(text_width("a?", 20), "the font of the picture has no '?'", InputError);
}

TEST_CASE("picture: paths are as dark as their values, up to full ink") {
  const double none = brightness(0), faint = brightness(0.5), strong = brightness(1);
  CHECK(none - strong == doctest::Approx(2 * (none - faint)).epsilon(0.25));  // except for gamma
  CHECK(strong > brightness(2));
  CHECK(brightness(2) == brightness(50));
}

TEST_CASE("picture: a tree tints its panel") {
  const Quadtree tree({{-1.5, 0}, {3, 1}}, {});
  Panel panels[] = {{.title = "", .paths = {}, .variances = {1, 1}, .color = kBlack}};
  const std::vector<double> uniform(64, 1);
  const Image plain = draw_picture({}, panels, uniform, 1);
  panels[0].tree = &tree;
  const Image tinted = draw_picture({}, panels, uniform, 1);
  CHECK(tinted.rgb(100, 100).g < plain.rgb(100, 100).g - 0.1f);
  CHECK(tinted.rgb(100, plain.height() - 30) == plain.rgb(100, plain.height() - 30));
}

}  // namespace pharos::focal::plane
