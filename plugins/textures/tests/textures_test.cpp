#include <doctest/doctest.h>

#include "../checkerboard.h"
#include "../constant.h"

namespace pharos {
namespace {

Rgb at(const Texture& texture, float u, float v) {
  SurfacePoint point;
  point.uv = {u, v};
  return texture.evaluate(point);
}

}  // namespace

TEST_CASE("constant texture") {
  const ConstantTexture texture({.value = {0.1f, 3, 0.5f}});
  CHECK(at(texture, 0.3f, -7) == Rgb(0.1f, 3, 0.5f));
  CHECK(texture.maximum() == 3);
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
  CHECK(texture.maximum() == 1);
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

}  // namespace pharos
