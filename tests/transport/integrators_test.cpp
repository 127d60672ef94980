// Path tracing compared with light tracing and with bidirectional path tracing in one room: matt
// and glossy surfaces, interpolated shading normals, rough or clear glass, in empty space and in
// fog, under every kind of light and through every kind of sensor, in pairs. Images are compared by
// the protocol of statistics/image_agreement.h.

#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "agreement.h"
#include "renders.h"

namespace pharos::testing {
namespace {

/// A light: an emitting shape, or an emitter without a shape.
struct LightParts {
  std::string shape, emitter;
};

const std::map<std::string, LightParts> kLights{
    {"area",
     {.shape = "{ type: quad, material: black, emitter: { type: area, radiance: [6, 5, 4] }, "
               "to_world: [ { scale: 0.4 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, "
               "{ translate: [0.3, 1.9, 0.4] } ] }"}},
    {"lamp",  // in the box of fog
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
    {"environment_map",
     {.emitter = "{ type: environment_map, file: '" PHAROS_SCENES "/materials/studio.hdr' }"}},
    {"sky",
     {.emitter = "{ type: sky, turbidity: 3, sun_direction: [1, 1, 0.5], scale: 20, resolution: 64 "
                 "}"}},
    {"constant and sun",
     {.emitter = "{ type: constant, radiance: [0.2, 0.3, 0.5] }, { type: sun, turbidity: 3, "
                 "sun_direction: [0.4, 1, 0.5], radius_scale: 20, scale: 0.01 }"}},
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

enum class Fog { none, box, everywhere };

/// The setup of a comparison.
struct Case {
  const char *light, *sensor;
  Fog fog = Fog::none;
  int spp = 64;
  const char* crop = "";
  const char* glass = "rough_dielectric, alpha: 0.4";
  const char* settings = "";  ///< settings of the other integrator
  const char* more = "";      ///< further shapes
};

/// A vase and a ball of glass on a floor in front of a wall, with or without fog.
std::string scene(const Case& c) {
  const bool foggy = c.fog != Fog::none;
  const auto& [shape, emitter] = kLights.at(c.light);
  std::string text = R"(scene:
  materials:
    floor: { type: rough_plastic, alpha: 0.3, reflectance: [0.5, 0.4, 0.3] }
    wall: { type: two_sided, bsdf: { type: diffuse, reflectance: [0.4, 0.6, 0.5] } }
    glass: { ior: 1.5, type: GLASS }
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
  if (c.fog == Fog::box) {
    text +=
        "    - { type: box, material: pass_through, interior: fog, to_world: [ { scale: [0.9, 0.7, "
        "0.6] }, { translate: [0, 0.71, 0.1] } ] }\n";
  }
  text += c.more;
  if (!shape.empty()) text += "    - " + shape + "\n";
  if (!emitter.empty()) text += "  emitters: [ " + emitter + " ]\n";
  if (c.fog == Fog::everywhere) text += "  medium: fog\n";
  text.replace(text.find("GLASS"), 5, c.glass);
  return text + "  sensor: { " + kSensors.at(c.sensor) + " }\n" + "sampler: independent\n" +
         fmt::format("film: {{ width: 24, height: 24, filter: box{} }}\n", c.crop);
}

LoadedConfig load(const std::string& scene, const std::string& integrator, int spp) {
  return config_from(scene +
                     fmt::format("integrator: {{ {} }}\nbudget: {{ spp: {} }}\n", integrator, spp));
}

void check(const Case& c, const std::string& integrator) {
  constexpr int kRenders = 24;
  const std::string text = scene(c);
  const char* fog = c.fog == Fog::none ? "" : c.fog == Fog::box ? ", box of fog" : ", in fog";
  const std::string name =
      fmt::format("{}: {}, {}{}{}{}", integrator, c.light, c.sensor, fog, c.crop, c.settings);
  CAPTURE(name);
  const Renders path = render_seeds(load(text, "type: path, max_depth: 4", c.spp), kRenders, 1);
  const Renders other = render_seeds(
      load(text, "max_depth: 4, type: " + integrator + c.settings, c.spp), kRenders, 1001);
  const statistics::AgreementOptions options{.image_bias = 0.03};
  const auto result = statistics::compare_images(path.side(), other.side(), options);
  print_agreement(name, c.spp, result);
  check_agreement(result);
}

constexpr const char* kCrop = ", crop: { x: 4, y: 8, width: 16, height: 16 }";

/// No sensor is in fog: in light tracing, light that scatters close to the lens causes rare bright
/// splats, which are too few for a test.
std::vector<Case> light_cases() {
  return {{"area", "perspective"},
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
          {"sun", "thin_lens", Fog::box}};
}

std::vector<Case> bidirectional_cases() {
  constexpr const char* kClear = "dielectric";
  constexpr const char* kGuided =
      ", guiding: { learner: stub_vertices, guider: stub_vertices, training: { iterations: 2 } }";
  // A half-transparent mask, a smooth coat over a matt wall, and a sheet of glass.
  constexpr const char* kScreens =
      "    - { type: quad, material: { type: mask, opacity: 0.5, bsdf: wall }, to_world: [ { "
      "scale: "
      "0.3 }, { translate: [0.3, 0.5, 0.9] } ] }\n"
      "    - { type: quad, material: { type: plastic, reflectance: [0.5, 0.3, 0.2] }, to_world: [ "
      "{ "
      "scale: 0.5 }, { rotate: { axis: [0, 1, 0], degrees: 40 } }, { translate: [-0.9, 0.6, -0.3] "
      "} "
      "] }\n"
      "    - { type: quad, material: { type: thin_dielectric, ior: 1.5 }, to_world: [ { scale: 0.3 "
      "}, { translate: [-0.5, 0.5, 0.9] } ] }\n";
  return {{"area", "perspective", Fog::none, 64, "", kClear},
          {"area", "thin_lens", Fog::box, 64, "", kClear, kGuided},
          {"area", "orthographic", Fog::everywhere, 128, kCrop},
          {"lamp", "perspective", Fog::everywhere, 192},
          {"lamp", "orthographic", Fog::box, 128, "", kClear},
          {"directional_area", "thin_lens", Fog::none, 64, "", kClear, ", light_selection: all"},
          {"directional_area", "orthographic", Fog::everywhere, 192},
          {"von_mises_fisher", "perspective", Fog::box, 64, kCrop},
          {"von_mises_fisher", "orthographic"},
          {"point", "perspective", Fog::none, 64, kCrop},
          {"point", "orthographic", Fog::box},
          {"point", "thin_lens", Fog::box},
          {"spot", "perspective", Fog::box},
          {"spot", "thin_lens", Fog::none},
          {"directional", "orthographic"},
          {"directional", "thin_lens", Fog::box},
          {"constant", "orthographic", Fog::box, 64, "", kClear},
          {"constant", "perspective", Fog::none, 64, "", kClear, kGuided},
          {"environment_map", "thin_lens", Fog::none, 64, "", kClear},
          {"environment_map", "perspective", Fog::box},
          {"sky", "perspective", Fog::none, 64, kCrop},
          {"sun", "thin_lens", Fog::box, 64, "", "rough_dielectric, alpha: 0.4",
           ", light_selection: all"},
          {"constant and sun", "orthographic", Fog::none, 64, "", kClear, kGuided, kScreens},
          {"area", "perspective", Fog::box, 128, "", kClear, "", kScreens}};
}

/// Checks every third case.
void check_some(const std::vector<Case>& cases, const std::string& integrator) {
  for (std::size_t i = 0; i < cases.size(); i += 3) check(cases[i], integrator);
}

void check_all(const std::vector<Case>& cases, const std::string& integrator) {
  for (const Case& c : cases) check(c, integrator);
}

TEST_CASE("path tracing and light tracing show the same") {
  check_some(light_cases(), "light");
}

TEST_CASE("path tracing and bidirectional path tracing show the same") {
  check_some(bidirectional_cases(), "bidirectional");
}

TEST_CASE("long: path tracing and light tracing always show the same") {
  check_all(light_cases(), "light");
}

TEST_CASE("long: path tracing and bidirectional path tracing always show the same") {
  check_all(bidirectional_cases(), "bidirectional");
}

}  // namespace
}  // namespace pharos::testing
