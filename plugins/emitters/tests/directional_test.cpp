#include "../directional.h"

#include <string>

#include <doctest/doctest.h>

#include <pharos/config/registry.h>
#include <pharos/core/error.h>

namespace pharos {
namespace {

DirectionalEmitter::Settings read(const std::string& yaml) {
  const Registry registry;
  BuildContext context{registry};
  ConfigNode resolved;
  return Value<DirectionalEmitter::Settings>::read(parse_yaml(yaml, "test"), context, resolved);
}

}  // namespace

TEST_CASE("directional: the same irradiance everywhere, from the other end of its direction") {
  const DirectionalEmitter emitter(
      {.irradiance = {1, 0.5f, 0}, .direction = {0, 3, -4}, .scale = 2});
  CHECK_FALSE(emitter.needs_shape());
  const auto light = emitter.place({.scene_center = {5, 0, 0}, .scene_radius = 2});
  for (const Point3 from : {Point3{0, 0, 0}, Point3{6, 1, 1}}) {
    const LightSample s = light->sample(from, {0.3f, 0.4f});
    CHECK(length(s.direction - Vec3{0, -0.6f, 0.8f}) < 1e-6f);
    CHECK(s.radiance == Rgb(2, 1, 0));
    CHECK(s.pdf == 1);
    CHECK(s.discrete);
    CHECK(s.distance == kInfinity);
    CHECK(s.kind == VertexKind::environment);
    CHECK(length(s.point.position - Point3{5, 0, 0}) > 2);
  }
  CHECK_FALSE(light->is_environment());  // rays that leave the scene do not meet it
  CHECK(light->power() == doctest::Approx(kPi * 4 * 1));
}

TEST_CASE("directional: a direction has a length") {
  CHECK_NOTHROW(read("direction: [0, 1e-6, 1e6]"));
  CHECK_THROWS_WITH_AS(read("direction: [0, 0, 0]"), doctest::Contains("a direction"), InputError);
  CHECK_THROWS_AS(read("direction: [0, 1e-38, 0]"), InputError);
  CHECK_THROWS_AS(read("irradiance: -1"), InputError);
}

}  // namespace pharos
