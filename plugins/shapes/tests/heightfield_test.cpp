#include "../heightfield.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "shape_test_kit.h"

namespace pharos {
namespace {

/// A texture given by a formula of the texture coordinates.
template <class Formula>
class FormulaTexture : public Texture {
 public:
  explicit FormulaTexture(Formula formula) : formula_(formula) {}
  Rgb value_at(const SurfacePoint& point) const override {
    const float v = formula_(point.uv);
    return {v - 0.1f, v, v + 0.1f};
  }
  Rgb maximum() const override { return Rgb(1); }
  Rgb average() const override { return Rgb(0.5f); }

 private:
  Formula formula_;
};

template <class Formula>
Ref<Texture> texture(Formula formula) {
  return std::make_shared<const FormulaTexture<Formula>>(formula);
}

const Ref<Texture> kFlat = texture([](Vec2) { return 0.25f; });
const Ref<Texture> kSlope = texture([](Vec2 uv) { return 0.5f * uv.x + 0.25f * uv.y; });

TEST_CASE("a flat heightfield is the square at its height") {
  const Heightfield flat({.texture = kFlat, .resolution = {7, 4}, .height = 2});
  CHECK(flat.area() == doctest::Approx(4));
  CHECK(flat.primitive_count() == 2 * 6 * 3);
  CHECK(flat.bounds().low == Point3{-1, -1, 0.5f});
  CHECK(flat.bounds().high == Point3{1, 1, 0.5f});
  for (const Vec3 n : flat.mesh()->normals) CHECK(n.z == doctest::Approx(1));
}

TEST_CASE("heights are those of the texture, under the texture coordinates of a quad") {
  const auto bump = [](Vec2 uv) { return uv.x * uv.x * (1 - uv.y); };
  const auto scene = test::scene_of<Heightfield>(
      {.texture = texture(bump), .resolution = {201, 201}, .height = 0.5f});
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 uv = random.next_2d();
    SurfacePoint p;
    const float t = scene->intersect({{2 * uv.x - 1, 2 * uv.y - 1, 3}, {0, 0, -1}}, p);
    CHECK(3 - t == doctest::Approx(0.5 * bump(uv)).epsilon(1e-3));
    CHECK(p.uv.x == doctest::Approx(uv.x).epsilon(1e-3));
    CHECK(p.uv.y == doctest::Approx(uv.y).epsilon(1e-3));
    // The gradient of 0.5 u^2 (1 - v) in x = 2 u - 1 and y = 2 v - 1.
    const Vec3 exact = normalize(Vec3{-0.5f * uv.x * (1 - uv.y), 0.25f * uv.x * uv.x, 1});
    CHECK(dot(p.shading.n, exact) > 0.99998f);
    CHECK(p.normal.z > 0);
  }
}

TEST_CASE("a slope has its normal everywhere, facets or smooth, mirrored or flipped") {
  const Vec3 exact = normalize(Vec3{-0.25f, -0.125f, 1});  // z = 0.25 x + 0.125 y + c
  for (const bool smooth : {false, true}) {
    for (const bool flip : {false, true}) {
      for (const float mirror : {1.0f, -1.0f}) {
        const Transform map = Transform::scale({mirror, 1, 1});
        const Heightfield field({.texture = kSlope,
                                 .resolution = {5, 3},
                                 .smooth = smooth,
                                 .to_world = map,
                                 .flip_normals = flip});
        const Vec3 expected = (flip ? -1.0f : 1.0f) * (Vec3{mirror, 1, 1} * exact);
        CHECK(field.mesh()->normals.empty() == !smooth);
        for (std::uint32_t i = 0; i < field.primitive_count(); ++i) {
          const SurfacePoint p = field.mesh()->surface_point(i, 0.3f, 0.3f);
          CHECK(dot(p.normal, expected) == doctest::Approx(1));
          CHECK(dot(p.shading.n, expected) == doctest::Approx(1));
        }
        CHECK(field.area() == doctest::Approx(4 / exact.z));
      }
    }
  }
}

TEST_CASE("heightfields that cannot be are refused") {
  const Ref<Texture> high = texture([](Vec2) { return 1e30f; });
  const auto huge = [&] { Heightfield({.texture = high, .height = 1e30f}); };
  CHECK(test::input_error(huge) == "heightfield has a vertex that is not finite");
  const auto fine = [&] { Heightfield({.texture = kFlat, .resolution = {100'000, 100'000}}); };
  CHECK(test::input_error(fine).find("triangles; at most") != std::string::npos);
}

}  // namespace
}  // namespace pharos
