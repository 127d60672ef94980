#include <doctest/doctest.h>

#include "../checkerboard.h"
#include "../constant.h"
#include "../grid.h"
#include "../mix.h"
#include "../scale.h"

namespace pharos {
namespace {

Rgb at(const Texture& texture, float u, float v) {
  SurfacePoint point;
  point.uv = {u, v};
  return texture.evaluate(point);
}

/// The mean over the unit square of texture coordinates.
Rgb mean_of(const Texture& texture) {
  constexpr int kSteps = 500;
  double sums[3] = {};
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const Rgb c = at(texture, (static_cast<float>(i % kSteps) + 0.5f) / kSteps,
                     (static_cast<float>(i / kSteps) + 0.5f) / kSteps);
    for (int k = 0; k < 3; ++k) sums[k] += double{c[k]} / (kSteps * kSteps);
  }
  return {static_cast<float>(sums[0]), static_cast<float>(sums[1]), static_cast<float>(sums[2])};
}

}  // namespace

TEST_CASE("constant texture") {
  const ConstantTexture texture({.value = {0.1f, 3, 0.5f}});
  CHECK(at(texture, 0.3f, -7) == Rgb(0.1f, 3, 0.5f));
  CHECK(texture.maximum() == Rgb(0.1f, 3, 0.5f));
  CHECK(texture.average() == Rgb(0.1f, 3, 0.5f));
}

TEST_CASE("checkerboard: two by two squares a unit") {
  const Rgb black(0), white(1);
  const Checkerboard texture({.color0 = white, .color1 = black});
  CHECK(at(texture, 0.25f, 0.25f) == white);
  CHECK(at(texture, 0.75f, 0.25f) == black);
  CHECK(at(texture, 0.25f, 0.75f) == black);
  CHECK(at(texture, 0.75f, 0.75f) == white);
  CHECK(at(texture, 0, 0) == white);
  CHECK(at(texture, 0.5f, 0) == black);
  CHECK(texture.maximum() == white);
  CHECK(texture.average() == Rgb(0.5f));
}

TEST_CASE("checkerboard: goes on beyond the unit square, negative side included") {
  const Rgb black(0), white(1);
  const Checkerboard texture({.color0 = white, .color1 = black});
  CHECK(at(texture, 5.25f, 0.25f) == white);
  CHECK(at(texture, -0.25f, 0.25f) == black);
  CHECK(at(texture, -0.25f, -0.25f) == white);
  CHECK(at(texture, -0.75f, 0.25f) == white);
}

TEST_CASE("checkerboard: scale") {
  const Rgb black(0), white(1);
  const Checkerboard texture({.color0 = white, .color1 = black, .uv_scale = {4, 1}});
  CHECK(at(texture, 0.0625f, 0.25f) == white);
  CHECK(at(texture, 0.1875f, 0.25f) == black);
  CHECK(at(texture, 0.3125f, 0.25f) == white);
}

TEST_CASE("grid: lines about whole coordinates") {
  const Rgb ground(0.8f), line(0.1f, 0.2f, 0.9f);
  const GridTexture texture({.color0 = ground, .color1 = line, .line_width = 0.1f});
  CHECK(at(texture, 0, 0.5f) == line);
  CHECK(at(texture, 0.5f, 0.09f) == line);
  CHECK(at(texture, 0.5f, 0.91f) == line);
  CHECK(at(texture, 0.11f, 0.89f) == ground);
  CHECK(at(texture, -3.05f, 0.5f) == line);
  CHECK(at(texture, -3.5f, -0.5f) == ground);
  CHECK(texture.maximum() == Rgb(0.8f, 0.8f, 0.9f));
  const Rgb mean = mean_of(texture);
  for (int i = 0; i < 3; ++i) CHECK(texture.average()[i] == doctest::Approx(mean[i]).epsilon(1e-3));
}

TEST_CASE("grid: scale, and lines without or with all of the area") {
  const Rgb black(0), white(1);
  const GridTexture fine(
      {.color0 = black, .color1 = white, .line_width = 0.25f, .uv_scale = {4, 1}});
  CHECK(at(fine, 0.25f, 0.5f) == white);
  CHECK(at(fine, 0.125f, 0.5f) == black);
  const GridTexture none({.color0 = black, .color1 = white, .line_width = 0});
  CHECK(at(none, 0, 0) == black);
  CHECK(none.average() == black);
  const GridTexture all({.color0 = black, .color1 = white, .line_width = 0.5f});
  CHECK(at(all, 0.3f, 0.6f) == white);
  CHECK(all.average() == white);
}

TEST_CASE("scale: the product, a bound on it, and its average") {
  const Ref<Texture> checker = std::make_shared<Checkerboard>(
      Checkerboard::Settings{.color0 = Rgb(1), .color1 = Rgb(0.2f, 0.4f, 0)});
  const Ref<Texture> tint =
      std::make_shared<ConstantTexture>(ConstantTexture::Settings{.value = {0.5f, 1, 2}});
  const ScaleTexture tinted({.texture = checker, .factor = tint});
  CHECK(at(tinted, 0.25f, 0.25f) == Rgb(0.5f, 1, 2));
  CHECK(at(tinted, 0.75f, 0.25f) == Rgb(0.1f, 0.4f, 0));
  CHECK(tinted.maximum() == Rgb(0.5f, 1, 2));
  CHECK(tinted.average() == checker->average() * tint->average());

  // One texture is black where the other is white, so the mean of the product is not the product of
  // the means.
  const Ref<Texture> opposite =
      std::make_shared<Checkerboard>(Checkerboard::Settings{.color0 = Rgb(0), .color1 = Rgb(1)});
  const ScaleTexture masked({.texture = checker, .factor = opposite});
  const Rgb mean = mean_of(masked), average = masked.average();
  for (int i = 0; i < 3; ++i) CHECK(average[i] == doctest::Approx(mean[i]).epsilon(1e-4).scale(1));
  CHECK(average.r == doctest::Approx(0.1));
  const ScaleTexture squared({.texture = opposite, .factor = opposite});
  CHECK(squared.average().g == doctest::Approx(0.5));
}

TEST_CASE("scale: a product that is not finite is refused") {
  const Ref<Texture> huge =
      std::make_shared<ConstantTexture>(ConstantTexture::Settings{.value = Rgb(1e30f)});
  CHECK_THROWS_AS(ScaleTexture({.texture = huge, .factor = huge}), InputError);
}

TEST_CASE("mix: between two textures, its bound and its average") {
  const auto color = [](Rgb value) -> Ref<Texture> {
    return std::make_shared<ConstantTexture>(ConstantTexture::Settings{.value = value});
  };
  const Ref<Texture> checker =
      std::make_shared<Checkerboard>(Checkerboard::Settings{.color0 = Rgb(0), .color1 = Rgb(1)});
  const MixTexture constant(
      {.first = color({0, 1, 2}), .second = color(Rgb(1)), .weight = color({0.25f, 0.5f, 1})});
  CHECK(at(constant, 0.3f, 0.9f) == Rgb(0.25f, 1, 1));
  CHECK(constant.average() == Rgb(0.25f, 1, 1));
  CHECK(constant.maximum() == Rgb(1, 1, 2));

  const MixTexture squares(
      {.first = color(Rgb(0.5f)), .second = color({0, 1, 3}), .weight = checker});
  CHECK(at(squares, 0.25f, 0.25f) == Rgb(0.5f));
  CHECK(at(squares, 0.75f, 0.25f) == Rgb(0, 1, 3));
  const MixTexture inverted({.first = color(Rgb(1)), .second = color(Rgb(0)), .weight = checker});
  CHECK(at(inverted, 0.25f, 0.25f) == Rgb(1));

  // The weight is correlated with both textures.
  const MixTexture same({.first = color(Rgb(0.3f)), .second = checker, .weight = checker});
  for (const MixTexture* mix : {&squares, &inverted, &same}) {
    const Rgb mean = mean_of(*mix), average = mix->average();
    for (int i = 0; i < 3; ++i) CHECK(average[i] == doctest::Approx(mean[i]).epsilon(1e-4));
  }
  CHECK(same.average().r == doctest::Approx(0.65));
}

TEST_CASE("mix: a weight above 1 is refused") {
  const auto color = [](float value) -> Ref<Texture> {
    return std::make_shared<ConstantTexture>(ConstantTexture::Settings{.value = Rgb(value)});
  };
  CHECK_THROWS_AS(MixTexture({.first = color(0), .second = color(1), .weight = color(1.5f)}),
                  InputError);
}

}  // namespace pharos
