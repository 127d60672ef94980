// Path tracing against light tracing in one room: matt and glossy surfaces, smooth shading normals,
// rough glass, in empty space and in a box of fog, under every kind of light and through every kind
// of sensor, in pairs. By the protocol of statistics/image_agreement.h.

#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "agreement.h"
#include "renders.h"

namespace pharos::testing {
namespace {

/// A light: a shape that shines, or an emitter that stands alone.
struct LightParts {
  std::string shape, emitter;
};

const std::map<std::string, LightParts> kLights{
    {"area",
     {.shape = "{ type: quad, material: black, emitter: { type: area, radiance: [6, 5, 4] }, "
               "to_world: [ { scale: 0.4 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, "
               "{ translate: [0.3, 1.9, 0.4] } ] }"}},
    {"lamp",  // inside the box of fog
     {.shape =
          "{ type: sphere, center: [0, 1.1, 0.3], radius: 0.25, material: black, exterior: fog, "
          "emitter: { type: area, radiance: [7, 6, 5] } }"}},
    {"directional_area",
     {.shape = "{ type: sphere, center: [-0.6, 1.6, 0.6], radius: 0.25, material: black, emitter: "
               "{ type: directional_area, radiance: 12, lobe: cosine_power, exponent: 3 } }"}},
    {"von_mises_fisher",
     {.shape = "{ type: quad, material: black, emitter: { type: directional_area, radiance: 40, "
               "lobe: von_mises_fisher, concentration: 8 }, to_world: [ { scale: 0.3 }, { rotate: "
               "{ axis: [1, 0, 0], degrees: 90 } }, { translate: [0, 1.9, 0] } ] }"}},
    {"point", {.emitter = "{ type: point, intensity: [3, 4, 5], position: [0.5, 1.6, 1.2] }"}},
    {"spot",
     {.emitter = "{ type: spot, intensity: 8, cutoff_angle: 40, beam_width: 10, to_world: { "
                 "look_at: { origin: [-0.5, 1.8, 1.5], target: [0, 0.3, 0], up: [0, 1, 0] } } }"}},
    {"directional",
     {.emitter = "{ type: directional, irradiance: [2, 2, 1], direction: [-0.3, -1, -0.5] }"}},
    {"constant", {.emitter = "{ type: constant, radiance: [0.5, 0.6, 0.8] }"}},
    {"sky",
     {.emitter = "{ type: sky, turbidity: 3, sun_direction: [1, 1, 0.5], scale: 20, resolution: 64 "
                 "}"}},
    {"sun",
     {.emitter = "{ type: sun, turbidity: 3, sun_direction: [0.4, 1, 0.5], radius_scale: 20, "
                 "scale: 0.01 }, { type: point, intensity: 1, position: [0.5, 1.6, 1.2] }"}}};

const std::map<std::string, std::string> kSensors{
    {"perspective",
     "type: perspective, fov: 45, to_world: { look_at: { origin: [0.2, 1.2, 3.5], target: "
     "[0, 0.5, 0], up: [0, 1, 0] } }"},
    {"thin_lens",
     "type: thin_lens, fov: 45, aperture_radius: 0.1, focus_distance: 3.4, to_world: { look_at: { "
     "origin: [0.2, 1.2, 3.5], target: [0, 0.5, 0], up: [0, 1, 0] } }"},
    {"orthographic",
     "type: orthographic, width: 2.6, to_world: { look_at: { origin: [0.2, 1.6, 3.5], target: "
     "[0, 0.5, 0], up: [0, 1, 0] } }"}};

enum class Fog { none, box };

/// A vase and a ball of glass on a floor before a wall, in a box of fog or without. (Not a sensor
/// in fog: light that scatters close to the lens comes in rare bright splats, too few for a test.)
std::string scene(const std::string& light, const std::string& sensor, Fog fog) {
  const bool foggy = fog != Fog::none;
  const auto& [shape, emitter] = kLights.at(light);
  std::string text = R"(scene:
  materials:
    floor: { type: rough_plastic, alpha: 0.3, reflectance: [0.5, 0.4, 0.3] }
    wall: { type: two_sided, bsdf: { type: diffuse, reflectance: [0.4, 0.6, 0.5] } }
    glass: { type: rough_dielectric, ior: 1.5, alpha: 0.4 }
    black: { type: diffuse, reflectance: 0 }
  media:
    fog: { type: homogeneous, scattering: [0.5, 0.7, 1], absorption: 0.1, phase: { type: henyey_greenstein, g: 0.4 } }
  shapes:
    - { type: quad, material: floor, to_world: [ { scale: 1.6 }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ] }
    - { type: quad, material: wall, to_world: [ { scale: 1.6 }, { translate: [0, 0, -1.2] } ] }
    - { type: lathe, material: wall, interpolation: catmull_rom, profile: [[0, 0], [0.3, 0], [0.15, 0.5], [0.35, 0.9]], to_world: [ { rotate: { axis: [1, 0, 0], degrees: -90 } }, { translate: [-0.4, 0.02, 0] } ] }
)";
  text +=
      std::string("    - { type: sphere, center: [0.45, 0.4, 0.2], radius: 0.3, material: glass") +
      (foggy ? ", exterior: fog }\n" : " }\n");
  if (fog == Fog::box) {
    text +=
        "    - { type: box, material: pass_through, interior: fog, to_world: [ { scale: [0.9, 0.7, "
        "0.6] }, { translate: [0, 0.71, 0.1] } ] }\n";
  }
  if (!shape.empty()) text += "    - " + shape + "\n";
  if (!emitter.empty()) text += "  emitters: [ " + emitter + " ]\n";
  return text + "  sensor: { " + kSensors.at(sensor) + " }\n" + "sampler: independent\n";
}

LoadedConfig load(const std::string& scene, const std::string& integrator, int spp) {
  return config_from(scene +
                     fmt::format("integrator: {{ {} }}\nbudget: {{ spp: {} }}\n", integrator, spp));
}

struct Case {
  const char *light, *sensor;
  Fog fog = Fog::none;
  int spp = 64;
  const char* crop = "";
};

void check(const Case& c) {
  constexpr int kRenders = 24;
  const std::string text =
      scene(c.light, c.sensor, c.fog) +
      fmt::format("film: {{ width: 24, height: 24, filter: box{} }}\n", c.crop);
  const std::string name = fmt::format("{}, {}{}{}", c.light, c.sensor,
                                       c.fog == Fog::none  ? ""
                                       : c.fog == Fog::box ? ", box of fog"
                                                           : ", in fog",
                                       c.crop);
  CAPTURE(name);
  const Renders path = render_seeds(load(text, "type: path, max_depth: 4", c.spp), kRenders, 1);
  const Renders light =
      render_seeds(load(text, "type: light, max_depth: 4", c.spp), kRenders, 1001);
  const statistics::AgreementOptions options{.image_bias = 0.03};
  const auto result = statistics::compare_images(path.side(), light.side(), options);
  print_agreement(name, c.spp, result);
  check_agreement(result);
}

TEST_CASE("path tracing and light tracing show the same") {
  constexpr const char* kCrop = ", crop: { x: 4, y: 8, width: 16, height: 16 }";
  for (const Case& c : {Case{"area", "perspective"},
                        {"area", "orthographic", Fog::box},
                        {"lamp", "perspective", Fog::box, 192},
                        {"directional_area", "thin_lens"},
                        {"area", "orthographic", Fog::none, 64, kCrop},
                        {"von_mises_fisher", "perspective", Fog::box},
                        {"point", "thin_lens", Fog::box},
                        {"point", "orthographic"},
                        {"spot", "perspective", Fog::none, 64, kCrop},
                        {"spot", "orthographic", Fog::box},
                        {"directional", "thin_lens"},
                        {"directional", "perspective", Fog::box},
                        {"constant", "perspective", Fog::box, 256},
                        {"constant", "thin_lens", Fog::none, 256},
                        {"sky", "perspective"},
                        {"sun", "thin_lens", Fog::box}}) {
    check(c);
  }
}

}  // namespace
}  // namespace pharos::testing
