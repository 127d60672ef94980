// Scenes and methods whose parts do not fit together.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

TEST_CASE("geometry, lights and sensors that are too far away") {
  const std::string limit = "at most 1e+09 scene units";
  const std::vector<std::string> says{"bad.yaml:2:", limit};
  for (const char* shape :
       {"{ type: quad, to_world: [{ scale: 1e10 }] }", "{ type: sphere, center: [0, -1e19, 0] }"}) {
    check_refused(config_with_shape(shape), {"bad.yaml:4:7: error: ", limit});
    check_refused(
        {.arguments = "validate bad.yaml",
         .prepare = [&](const ScratchFolder& f) { f.write("bad.yaml", config_with_shape(shape)); }},
        {"bad.yaml:4:7: error: ", limit});
  }
  for (const char* place : {"{ scale: 9e9 }", "{ translate: [1e30, 0, 0] }"}) {
    check_refused(
        "scene:\n  sensor: perspective\n  groups: { ball: [sphere] }\n  shapes:\n    - { "
        "type: instance, group: ball, to_world: [" +
            std::string(place) + "] }\nbudget: { spp: 1 }\n",
        {"bad.yaml:5:32: error: ", "the instance reaches", limit});
  }
  const auto with_sensor = [](const std::string& sensor) {
    return "scene:\n  sensor: " + sensor + "\n  shapes: [sphere]\nbudget: { spp: 1 }\n";
  };
  const auto from = [](const std::string& origin) {
    return "to_world: { look_at: { origin: " + origin + ", target: [0, 0, 0], up: [0, 1, 0] } }";
  };
  check_refused(with_sensor("{ type: perspective, " + from("[0, 0, 1e19]") + " }"), says);
  check_refused(
      with_sensor("perspective") + "sensor: { type: perspective, " + from("[0, 0, 1e12]") + " }\n",
      {"bad.yaml:5:", limit});
  // Scaled by `to_world`, or by the shape of the film.
  check_refused(with_sensor("{ type: orthographic, width: 1, to_world: [{ scale: 1e19 }] }"), says);
  check_refused(with_sensor("{ type: thin_lens, aperture_radius: 1, to_world: [{ scale: 1e19 }] }"),
                says);
  check_refused(
      with_sensor("{ type: orthographic, width: 1e9 }") + "film: { width: 1, height: 1000 }\n",
      says);
  check_refused(with_sensor("{ type: orthographic, width: 1e19 }"),
                {"width must be <= 1000000000"});
  check_refused(with_sensor("{ type: thin_lens, aperture_radius: 1e19 }"),
                {"aperture_radius must be <= 1000000000"});
  check_refused(with_sensor("{ type: thin_lens, focus_distance: 1e-40 }"), {"focus_distance must"});
  for (const char* light : {"{ type: point, position: [1e19, 0, 0] }",
                            "{ type: spot, to_world: [{ translate: [0, 1e19, 0] }] }"}) {
    check_refused("scene:\n  sensor: perspective\n  emitters: [" + std::string(light) +
                      "]\nbudget: { spp: 1 }\n",
                  {"bad.yaml:3:14: error: ", limit});
  }
}

/// A scene with these lines, which begin in line 2 and are indented by two spaces.
std::string scene_of(const std::string& lines) {
  return "scene:\n" + lines + "budget: { spp: 1 }\n";
}

TEST_CASE("all errors are told in one run, one a line, and not too many") {
  const ScratchFolder folder;
  std::string many = "scene:\n  shapes:\n";
  for (int i = 0; i < 30; ++i) many += "    - { type: spere }\n";
  folder.write("bad.yaml", many + "film: { width: 0, height: 0 }\nbudget: { spp: 1 }\n");
  const Outcome outcome = run_pharos("render bad.yaml", folder.path());
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find("bad.yaml:3:15: error: unknown shape 'spere'") == 0);
  CHECK(outcome.err.find("\nbad.yaml:22:15: error: ") != std::string::npos);
  CHECK(outcome.err.find("bad.yaml:23:") == std::string::npos);
  CHECK(outcome.err.find("\nat least 12 more errors\n") != std::string::npos);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("very many errors take little time and memory") {
  std::string materials = "scene:\n  materials:\n";
  for (int i = 0; i < 50'000; ++i) materials += fmt::format("    m{}: {{ type: difuse }}\n", i);
  check_refused(materials + "budget: { spp: 1 }\n", {"at least 80 more errors"});
}

TEST_CASE("a scene's own keys") {
  check_refused(scene_of("  shapes: []\n"), {"bad.yaml:1:1: error: ", "no sensor"});
  check_refused(scene_of("  sensor: null\n"), {"bad.yaml:1:1: error: ", "no sensor"});
  check_refused(scene_of("  sensr: perspective\n"), {"bad.yaml:2:3: error: ", "'sensor'"});
  check_refused(scene_of("  shapes: sphere\n"), {"bad.yaml:2:11: error: ", "a list of shapes"});
  check_refused(scene_of("  shapes: { type: sphere }\n"), {"bad.yaml:2:11", "a list of shapes"});
  check_refused(scene_of("  materials: [diffuse]\n"), {"bad.yaml:2:14: error: ", "a mapping"});
  check_refused(scene_of("  emitters: { type: constant }\n"), {"bad.yaml:2:13: ", "a list"});
  check_refused("scene: 3\nbudget: { spp: 1 }\n", {"bad.yaml:1:8: error: ", "'"});
  check_refused("scene: [a.yaml]\nbudget: { spp: 1 }\n", {"bad.yaml:1:8: error: ", "a scene"});
}

TEST_CASE("materials and textures by name") {
  check_refused(
      scene_of("  materials: { gold: diffuse }\n  shapes: [{ type: quad, material: glod }]\n"),
      {"bad.yaml:3:36: error: ", "did you mean 'gold'?", "named in the scene: 'gold'"});
  check_refused(scene_of("  materials:\n    a: b\n    b: a\n"),
                {"bad.yaml:3:8: error: ", "unknown bsdf 'b'"});
  check_refused(scene_of("  materials:\n    a: a\n"), {"bad.yaml:3:8: error: ", "bsdf 'a'"});
  check_refused(scene_of("  textures:\n    t: { type: bitmap, file: 3 }\n"),
                {"bad.yaml:3:", "/3'"});
  check_refused(scene_of("  textures: { wood: 0.2 }\n  shapes: [{ type: quad, material: wood }]\n"),
                {"bad.yaml:3:36: error: ", "unknown bsdf 'wood'"});
  check_refused(scene_of("  materials: { m: { type: diffuse, reflectance: wodo } }\n"),
                {"bad.yaml:2:", "unknown texture 'wodo'"});
  check_refused(scene_of("  shapes: [{ type: quad, interior: fog }]\n"),
                {"bad.yaml:2:36: error: ", "'fog'"});
}

TEST_CASE("emitters in the wrong place") {
  check_refused(config_with_shape("{ type: quad, emitter: { type: constant } }"),
                {"bad.yaml:4:30: error: ", "stands alone"});
  check_refused(scene_of("  emitters: [{ type: area, radiance: 1 }]\n"),
                {"bad.yaml:2:14: error: ", "needs a shape"});
  check_refused(config_with_shape("{ type: quad, emitter: { type: area } }"),
                {"bad.yaml:4:30: error: ", "'radiance'"});
  check_refused(config_with_shape("{ type: quad, emitter: area }"),
                {"bad.yaml:4:30: error: ", "'radiance'"});
  check_refused(scene_of("  emitters: [sphere]\n"), {"bad.yaml:2:14", "unknown emitter"});
}

TEST_CASE("shapes") {
  check_refused(config_with_shape("{ radius: 2 }"), {"bad.yaml:4:7: error: ", "'type'"});
  check_refused(config_with_shape("null"), {"bad.yaml:4:7: error: ", "shape", "nothing"});
  check_refused(config_with_shape("[sphere]"), {"bad.yaml:4:7: error: ", "shape"});
  check_refused(config_with_shape("{ type: sphere, radius: 0 }"),
                {"bad.yaml:4:31: error: ", "radius must be > 0"});
  check_refused(config_with_shape("{ type: sphere, to_world: { scale: [1, 2, 1] } }"),
                {"bad.yaml:4:", "scale"});
  check_refused(config_with_shape("{ type: mesh }"), {"bad.yaml:4:7: error: ", "'file'"});
  check_refused(config_with_shape("{ type: mesh, file: [a.ply] }"), {"bad.yaml:4:27", "a path"});
  check_refused(config_with_shape("{ type: mesh, file: \"\" }"), {"bad.yaml:4:27", "a path"});
}

TEST_CASE("guiding that does not fit together") {
  const auto refused = [](const std::string& guiding, const std::vector<std::string>& says) {
    check_refused({.arguments = "render bad.yaml",
                   .prepare =
                       [&](const ScratchFolder& f) {
                         f.write(
                             "bad.yaml",
                             config_with("integrator: { type: path, guiding: " + guiding + " }\n"));
                       },
                   .environment = "PHAROS_MODULE_PATH=" PHAROS_TEST_PLUGINS},
                  says);
  };
  refused("{}", {"bad.yaml:5:36: error: ", "a learner and a guider"});
  refused("{ learner: stub_direction }", {"bad.yaml:5:36: error: ", "no guider"});
  refused("{ guider: stub_direction }", {"bad.yaml:5:36: error: ", "no learner"});
  refused("{ learner: stub_dirextion, guider: stub_direction }",
          {"bad.yaml:5:47: error: ", "'stub_direction'"});
  refused("{ learner: stub_segments, guider: stub_direction }",
          {"bad.yaml:5:36: error: ", "stub_segments", "stub_direction"});
  refused("{ methods: [{ learner: stub_direction }] }", {"bad.yaml:5:48: error: ", "'guider'"});
  refused("{ methods: [{ guider: stub_direction }] }",
          {"bad.yaml:5:36: error: ", "the first method has no learner"});
  refused(
      "{ methods: [{ learner: stub_direction, guider: stub_direction }, { guider: stub_camera }] }",
      {"bad.yaml:5:36: error: ", "'stub_direction'", "'stub_camera'"});
  refused("{ methods: [{ learner: stub_direction, guider: stub_direction, weight: 0 }] }",
          {"bad.yaml:5:", "weight must be > 0"});
  refused("{ learner: stub_direction, guider: stub_direction, training: { share: 1 } }",
          {"bad.yaml:5:", "share must be", "< 1"});
  refused("{ learner: stub_direction, guider: stub_direction, training: { iterations: -1 } }",
          {"bad.yaml:5:", "error: "});
}

TEST_CASE("names that plugins had before") {
  const auto guided = [](const std::string& learner, const std::string& guider) {
    return "scene:\n  sensor: perspective\nbudget: { spp: 1 }\nintegrator:\n  type: path\n"
           "  guiding: { learner: " +
           learner + ", guider: " + guider + " }\n";
  };
  check_refused(guided("sd_tree", "sd_tree"),
                {"bad.yaml:6:23: error: the learner 'sd_tree' is called 'practical_path_guiding'"});
  check_refused(guided("{ type: vmf_mixtures }", "vmf_mixtures"),
                {"bad.yaml:6:31: error: the learner 'vmf_mixtures' is called "
                 "'parallax_aware_mixtures' now"});
  check_refused(guided("focal", "vmf_mixtures"),
                {"error: the guider 'vmf_mixtures' is called 'parallax_aware_mixtures' now"});
}

TEST_CASE("a method that names a model without the learner that can read it") {
  check_refused(
      "scene:\n  sensor: perspective\nbudget: { spp: 1 }\nintegrator:\n  type: path\n"
      "  guiding: { methods: [ { learner: uniform, guider: uniform }, { guider: uniform, model: "
      "a.model } ] }\n",
      {"needs the 'learner' that can read it"});
}

}  // namespace
}  // namespace pharos::testing
