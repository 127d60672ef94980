#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "mapping_test_kit.h"

namespace pharos::mitsuba::test {
namespace {

std::string light(std::string type, std::vector<Property> properties = {},
                  Dialect dialect = Dialect::mitsuba_2) {
  return part(import_of({emitter(std::move(type), std::move(properties))}, dialect),
              "scene.emitters.0");
}

}  // namespace

TEST_CASE("lights: parameters and defaults") {
  CHECK(light("constant") == "{ type: constant, radiance: 1 }");
  CHECK(light("point", {value("intensity", rgb(1, 2, 3)), value("position", Triple{{4, 5, 6}})}) ==
        "{ type: point, intensity: [1, 2, 3], position: [4, 5, 6] }");
  CHECK(light("spot") ==
        "{ type: spot, intensity: 1, cutoff_angle: 20, beam_width: 15, falloff: linear }");
  CHECK(light("spot", {value("cutoff_angle", 40.0)}) ==
        "{ type: spot, intensity: 1, cutoff_angle: 40, beam_width: 30, falloff: linear }");
  CHECK(light("envmap", {value("filename", "sky.exr"), value("scale", 2.0)}) ==
        "{ type: environment_map, file: sky.exr, scale: 2 }");
  CHECK(
      part(import_of({shape("cube", {nested(emitter("area", {value("radiance", rgb(4, 3, 2))}))})}),
           "scene.shapes.0.emitter") == "{ type: area, radiance: [4, 3, 2] }");
}

TEST_CASE("lights: a directional light goes along its direction, else along +z of its space") {
  CHECK(light("directional", {value("direction", Triple{{1, -2, 0}})}) ==
        "{ type: directional, irradiance: 1, direction: [1, -2, 0] }");
  CHECK(light("directional") == "{ type: directional, irradiance: 1, direction: [0, 0, 1] }");
  const Transform down = Transform::look_at({0, 5, 0}, {0, 0, 0}, {1, 0, 0});
  CHECK(light("directional", {value("to_world", down)}) ==
        "{ type: directional, irradiance: 1, direction: [0, -1, 0] }");
}

TEST_CASE("lights: what spots cannot show is noted") {
  const Import import = import_of({emitter("spot", {nested(texture("checkerboard"), "texture")})});
  CHECK(notes(import)[1] == "emitter spot: 'texture' is left out");
}

TEST_CASE("lights: daylight is a sky and a sun") {
  const std::vector<Property> stated{
      value("turbidity", 4.0), value("sun_direction", Triple{{1, 1, 0}}), value("sun_scale", 3.0),
      value("scale", 2.0), value("sun_radius_scale", 5.0)};
  const Import import = import_of({emitter("sunsky", stated)}, Dialect::mitsuba_0);
  CHECK(part(import, "scene.emitters") ==
        "[{ type: sky, turbidity: 4, sun_direction: [1, 1, 0], scale: 2 }, "
        "{ type: sun, turbidity: 4, sun_direction: [1, 1, 0], scale: 6, radius_scale: 5 }]");
  CHECK(light("sky", {value("hour", 9.5), value("latitude", 50.0)}, Dialect::mitsuba_0) ==
        "{ type: sky, turbidity: 3, observer: { latitude: 50, hour: 9.5 } }");
}

TEST_CASE("lights: the zenith is +y in 0.x and +z in 3") {
  CHECK(light("sky", {}, Dialect::mitsuba_0) == "{ type: sky, turbidity: 3 }");
  const Spectrum grass{.value = {0.2f, 0.4f, 0.1f}};
  CHECK(light("sky", {value("albedo", grass)}, Dialect::mitsuba_0) ==
        "{ type: sky, turbidity: 3, ground: [0.2, 0.4, 0.1] }");
  const Import import = import_of({emitter("sky")}, Dialect::mitsuba_2);
  const ConfigNode* matrix =
      import.config.find("scene")->find("emitters")->items()[0].find("to_world");
  REQUIRE(matrix != nullptr);
  // The column of y, the zenith of the sky.
  const std::vector<ConfigNode>& m = matrix->find("matrix")->items();
  CHECK(std::stod(m[1].text()) == doctest::Approx(0));
  CHECK(std::stod(m[5].text()) == doctest::Approx(0).epsilon(1e-6));
  CHECK(std::stod(m[9].text()) == doctest::Approx(1));
}

TEST_CASE("lights: spectra that are no colors are noted") {
  const Spectrum lamp{.value = {1, 0.8f, 0.6f}, .approximated = true};
  const Import import = import_of({emitter("constant", {value("radiance", lamp)})});
  CHECK(notes(import)[1] == "emitter constant: the spectrum of 'radiance' is brought to RGB");
}

}  // namespace pharos::mitsuba::test
