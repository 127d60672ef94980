#include "../area.h"

#include <array>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "ceiling.h"

namespace pharos {
namespace {

/// A texture that is red in one half and blue in the other.
class TwoColors : public Texture {
 public:
  Rgb value_at(const SurfacePoint& p) const override {
    return p.uv.x < 0.5f ? Rgb(4, 0, 0) : Rgb(0, 0, 2);
  }
  Rgb maximum() const override { return {4, 0, 2}; }
  Rgb average() const override { return {2, 0, 1}; }
};

struct LitCeiling {
  Ceiling shape;
  AreaEmitter emitter;
  std::unique_ptr<const Light> light;

  explicit LitCeiling(Ref<Texture> radiance, float scale = 1)
      : emitter({.radiance = std::move(radiance), .scale = scale}),
        light(emitter.place({.shape = &shape, .object = 7, .scene_center = {}})) {}
};

/// The irradiance of a polygon of radiance 1 by Lambert's formula: half the sum over its edges of
/// the angle that the edge spans times the cosine between the receiver's normal and the normal of
/// the plane of this angle.
double lambert_irradiance(Point3 at, Vec3 normal, const std::array<Point3, 4>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = normalize(corners[i] - at), b = normalize(corners[(i + 1) % 4] - at);
    sum += std::acos(double{dot(a, b)}) * dot(normalize(cross(a, b)), normal);
  }
  return std::abs(sum) / 2;
}

TEST_CASE("sampled irradiance is Lambert's") {
  const LitCeiling ceiling(std::make_shared<const OneColor>(Rgb(1, 2, 4)), 3);
  const Vec3 up = normalize({0.2f, -0.1f, 1});
  for (const Point3 at : {Point3{0, 0, 0}, Point3{2, -1, 1}, Point3{0.5f, 1, 2.5f}}) {
    Rgb irradiance;
    constexpr int count = 300;
    for (int i = 0; i < count * count; ++i) {
      const Vec2 u{(i % count + 0.5f) / count, (i / count + 0.5f) / count};
      const LightSample s = ceiling.light->sample(at, u);
      irradiance += std::max(0.0f, dot(s.direction, up)) / s.pdf / (count * count) * s.radiance;
    }
    const double exact = 3 * lambert_irradiance(at, up, Ceiling::corners);
    CHECK(irradiance.r == doctest::Approx(exact).epsilon(2e-3));
    CHECK(irradiance.b == doctest::Approx(4 * exact).epsilon(2e-3));
  }
}

TEST_CASE("a sample tells where it lies, and its density is that of the point") {
  const LitCeiling ceiling(std::make_shared<const TwoColors>());
  const Point3 from{0.5f, 0.25f, 1};
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const LightSample s = ceiling.light->sample(from, random.next_2d());
    CHECK(length(from + s.distance * s.direction - s.point.position) < 1e-5f);
    CHECK(ceiling.light->pdf_point(from, s.point) == doctest::Approx(s.pdf));
    CHECK(s.point.object == 7);
    CHECK(s.kind == VertexKind::surface);
    CHECK_FALSE(s.discrete);
    CHECK(s.radiance == ceiling.light->radiance(s.point, -s.direction));
    CHECK(s.radiance == (s.point.position.x < 0 ? Rgb(4, 0, 0) : Rgb(0, 0, 2)));
  }
}

TEST_CASE("only the side of the normal shines") {
  const LitCeiling ceiling(std::make_shared<const OneColor>(Rgb(1)));
  const SurfacePoint p = ceiling.shape.sample({0.5f, 0.5f}).point;
  CHECK(ceiling.light->radiance(p, {0, 0, -1}) == Rgb(1));
  CHECK(is_black(ceiling.light->radiance(p, {0, 0, 1})));
  CHECK(is_black(ceiling.light->radiance(p, {1, 0, 0})));
  CHECK(is_black(ceiling.light->sample({0, 0, 5}, {0.3f, 0.3f}).radiance));
}

TEST_CASE("nothing is sampled from a point on the light itself") {
  const LitCeiling ceiling(std::make_shared<const OneColor>(Rgb(1)));
  CHECK(ceiling.light->sample({0, 0, 3}, {0.5f, 0.5f}).pdf == 0);
  CHECK(ceiling.light->sample({0, 0, 3}, {0.2f, 0.5f}).pdf == 0);  // seen edge-on
}

TEST_CASE("power is pi times area times mean radiance") {
  const LitCeiling ceiling(std::make_shared<const TwoColors>(), 10);
  CHECK(ceiling.light->power() == doctest::Approx(kPi * 8 * 10 * 1));
  CHECK_FALSE(ceiling.light->is_environment());
  CHECK(ceiling.emitter.needs_shape());
}

}  // namespace
}  // namespace pharos
