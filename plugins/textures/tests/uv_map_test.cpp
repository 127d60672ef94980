#include "../uv_map.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

/// A texture whose color is the coordinates of the point.
class Coordinates final : public Texture {
 public:
  Rgb value_at(const SurfacePoint& point) const override {
    return {point.uv.x, point.uv.y, point.position.z};
  }
  Rgb maximum() const override { return Rgb(7); }
  Rgb average() const override { return {1, 2, 3}; }
};

Rgb at(const Texture& texture, float u, float v) {
  SurfacePoint point;
  point.uv = {u, v};
  point.position.z = 5;
  return texture.evaluate(point);
}

}  // namespace

TEST_CASE("uv_map: rows of the matrix give u and v, all else stays") {
  const UvMapTexture texture(
      {.texture = std::make_shared<const Coordinates>(), .matrix = {1, 2, 3, 4, 5, 6}});
  CHECK(at(texture, 10, 100) == Rgb(213, 546, 5));
  CHECK(texture.maximum() == Rgb(7));
  CHECK(texture.average() == Rgb(1, 2, 3));
}

TEST_CASE("uv_map: without a matrix nothing moves") {
  const UvMapTexture texture({.texture = std::make_shared<const Coordinates>()});
  CHECK(at(texture, 0.25f, 0.75f) == Rgb(0.25f, 0.75f, 5));
}

TEST_CASE("uv_map: six numbers, no more and no less") {
  for (const std::size_t count : {0, 5, 7}) {
    CHECK_THROWS_WITH_AS(UvMapTexture({.texture = std::make_shared<const Coordinates>(),
                                       .matrix = std::vector<float>(count, 1)}),
                         "uv_map: 'matrix' must have six numbers", InputError);
  }
}

}  // namespace pharos
