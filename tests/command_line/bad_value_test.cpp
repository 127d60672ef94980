// Wrong keys and values in configs: names, types, ranges, lengths.

#include <doctest/doctest.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

TEST_CASE("misspelt keys") {
  check_refused(config_with("smapler: sobol\n"),
                {"bad.yaml:5:1: error: ", "did you mean 'sampler'?"});
  check_refused(config_with("film: { widht: 3 }\n"), {"bad.yaml:5:9: error: ", "'width'"});
  check_refused(config_with("integrator: { type: path, max_dept: 3 }\n"), {"'max_depth'"});
  check_refused(config_with_shape("{ type: quad, materail: diffuse }"), {"'material'"});
  check_refused(config_with("film: { zzz: 3 }\n"), {"known keys: ", "'width'", "'filter'"});
}

TEST_CASE("terminations that do not fit") {
  check_refused(
      config_with("integrator: { type: path, roulette: throughput, termination: none }\n"),
      {"bad.yaml:5:", "'roulette' must be off"});
  check_refused(config_with("integrator: { type: path, training: { share: 0.2 } }\n"),
                {"bad.yaml:5:", "nothing learns"});
  check_refused(config_with("integrator: { type: light, termination: adjoint }\n"),
                {"bad.yaml:5:", "the termination 'adjoint' learns"});
  check_refused(
      config_with("integrator: { type: path, termination: { type: adjoint, least: 0 } }\n"),
      {"bad.yaml:5:", "least must be > 0"});
}

TEST_CASE("numbers") {
  check_refused(config_with("seed: many\n"), {"bad.yaml:5:7: error: ", "an integer", "'many'"});
  check_refused(config_with("seed: -1\n"), {"bad.yaml:5:7: error: ", "integer from 0"});
  check_refused(config_with("seed: 1.5\n"), {"bad.yaml:5:7: error: ", "an integer"});
  check_refused(config_with("seed: 1e3\n"), {"bad.yaml:5:7: error: ", "an integer"});
  check_refused(config_with("seed: 99999999999999999999\n"), {"bad.yaml:5:7: error: "});
  check_refused(config_with("seed: 0x\n"), {"bad.yaml:5:7: error: ", "an integer"});
  check_refused(config_with("seed: \"\"\n"), {"bad.yaml:5:7: error: ", "an integer"});
  check_refused(config_with("seed:\n"), {"bad.yaml:5:", "an integer", "nothing"});
  check_refused(config_with("seed: 1 2\n"), {"bad.yaml:5:7: error: ", "an integer"});
  for (const char* number : {".nan", "nan", ".inf", "-.inf", "infinity"}) {
    check_refused(config_with("output: { exposure: " + std::string(number) + " }\n"),
                  {"bad.yaml:5:21: error: ", "a finite number"});
  }
  check_refused(config_with("output: { exposure: 1e999 }\n"),
                {"bad.yaml:5:21: error: ", "magnitude"});
  check_refused(config_with("film: { filter: { type: gaussian, stddev: 0.01 } }\n"),
                {"bad.yaml:5:", "stddev must be >= 0.1"});
  check_refused(config_with("output: { exposure: -1e39 }\n"),
                {"bad.yaml:5:21: error: ", "magnitude"});
  check_refused(config_with("output: { exposure: 1,5 }\n"), {"bad.yaml:5:", "error: "});
  check_refused(config_with("sensor: { type: perspective, fov: 38deg }\n"),
                {"bad.yaml:5:35: error: ", "a number", "'38deg'"});
  check_refused(config_with("sensor: { type: perspective, fov: 180 }\n"),
                {"bad.yaml:5:35: error: ", "fov must be", "180"});
}

TEST_CASE("windows of the film") {
  const auto crop = [](const std::string& window) {
    return config_with("film: { width: 64, height: 48, crop: " + window + " }\n");
  };
  check_refused(crop("{ width: 65, height: 1 }"),
                {"bad.yaml:5:38: error: ", "a window of the film of 64 x 48", "(65, 1)"});
  check_refused(crop("{ x: 60, y: 4, width: 5, height: 4 }"), {"bad.yaml:5:38: error: "});
  check_refused(crop("{ y: 40, width: 5, height: 9 }"), {"bad.yaml:5:38: error: ", "(5, 49)"});
  check_refused(crop("{ width: 0, height: 4 }"), {"bad.yaml:5:47: error: ", "width must be"});
  check_refused(crop("{ x: -1, width: 4, height: 4 }"), {"bad.yaml:5:43: error: ", "x must be"});
  check_refused(crop("{ x: 1, y: 2, width: 4 }"), {"bad.yaml:5:38: error: ", "'height'"});
  check_refused(crop("{ x: 1, y: 2, widht: 4, height: 4 }"), {"'width'"});
  check_refused(crop("[1, 2, 3, 4]"), {"bad.yaml:5:38: error: "});
  check_refused(config_with("film: { width: 32768, height: 32768, crop: { width: 32768, height: "
                            "4096 } }\n"),
                {"bad.yaml:5:", "more than 67108864 pixels"});
}

TEST_CASE("types") {
  check_refused(config_with("film: 12\n"), {"bad.yaml:5:7: error: ", "a mapping"});
  check_refused(config_with("film: 512x512\n"), {"bad.yaml:5:7: error: ", "'width'"});
  check_refused(config_with("film: [512, 512]\n"), {"bad.yaml:5:7: error: ", "'width'"});
  check_refused(config_with("film: { width: [1, 2] }\n"), {"bad.yaml:5:16: error: "});
  check_refused(config_with("film: { width: 512px }\n"), {"bad.yaml:5:16: error: ", "'512px'"});
  check_refused(config_with("output: { png: perhaps }\n"), {"bad.yaml:5:16: error: "});
  check_refused(config_with("output: { png: yes }\n"), {"bad.yaml:5:16: error: ", "true or false"});
  check_refused(config_with("output: { image: [a.exr] }\n"), {"bad.yaml:5:18: error: "});
  check_refused(config_with("output: { aovs: albedo }\n"), {"bad.yaml:5:17: error: ", "a list"});
  check_refused(config_with("output: { aovs: [albeod] }\n"),
                {"bad.yaml:5:18: error: ", "'albedo'"});
  check_refused(config_with("output: { aovs: [albedo, albedo] }\n"),
                {"bad.yaml:5:", "aovs must be", "once"});
  check_refused(config_with("integrator: { type: path, mis: ballance }\n"), {"'balance'"});
  check_refused(config_with("integrator: { type: path, mis: { balance: 1 } }\n"),
                {"bad.yaml:5:32: error: ", "'power'"});
  check_refused(config_with("sensor: [1, 2, 3]\n"), {"bad.yaml:5:9: error: ", "'perspective'"});
  check_refused(config_with("sampler: { type: [sobol] }\n"), {"bad.yaml:5:18: error: "});
}

TEST_CASE("vectors, colors and transforms") {
  check_refused(config_with_shape("{ type: sphere, center: [1, 2] }"),
                {"bad.yaml:4:31: error: ", "3 numbers [x, y, z]"});
  check_refused(config_with_shape("{ type: sphere, center: [1, 2, up] }"),
                {"bad.yaml:4:38: error: ", "a number"});
  check_refused(config_with_shape("{ type: sphere, center: 1 }"), {"bad.yaml:4:31: error: "});
  const auto shape_with = [](const char* transform) {
    return config_with_shape("{ type: quad, to_world: " + std::string(transform) + " }");
  };
  check_refused(shape_with("up"), {"bad.yaml:4:31: error: ", "translate"});
  check_refused(shape_with("{ translat: [0, 0, 0] }"), {"bad.yaml:4:33: error: ", "'translate'"});
  check_refused(shape_with("{ translate: [0, 0, 0], scale: 2 }"), {"bad.yaml:4:31: error: "});
  check_refused(shape_with("{ scale: 0 }"), {"bad.yaml:4:31: error: ", "inverted"});
  check_refused(shape_with("{ scale: [1, 0, 1] }"), {"bad.yaml:4:31: error: ", "inverted"});
  check_refused(shape_with("[{ scale: 1e30 }, { scale: 1e30 }]"), {"bad.yaml:4:", "inverted"});
  check_refused(shape_with("{ rotate: { axis: [0, 0, 0], degrees: 3 } }"),
                {"bad.yaml:4:31: error: ", "axis"});
  check_refused(shape_with("{ rotate: { axis: [0, 0, 1] } }"), {"bad.yaml:4:41", "'degrees'"});
  check_refused(shape_with("{ look_at: { origin: [1, 1, 1], target: [1, 1, 1] } }"),
                {"bad.yaml:4:31: error: ", "same point"});
  check_refused(shape_with("{ look_at: { origin: [0, 0, 0], target: [0, 2, 0] } }"),
                {"bad.yaml:4:31: error: ", "parallel"});
  check_refused(shape_with("{ look_at: { origin: [0, 0, 0], target: [0, 0, 2], up: [0, 0, 0] } }"),
                {"bad.yaml:4:31: error: ", "up has no direction"});
  check_refused(shape_with("{ matrix: [1, 0, 0, 0] }"), {"bad.yaml:4:41: error: ", "12 or 16"});
  check_refused(shape_with("{ matrix: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,0] }"),
                {"bad.yaml:4:", "last row"});
  check_refused(shape_with("{ matrix: [1,0,0,0, 0,1,0,0, 1,1,0,0] }"), {"bad.yaml:4:", "inverted"});
  const auto color = [](const char* value) {
    return config_with_shape(
        "{ type: quad, material: { type: diffuse, reflectance: " + std::string(value) + " } }");
  };
  check_refused(color("[1, 0]"), {"bad.yaml:4:", "a color"});
  check_refused(color("[0.1, 0.2, 1.5]"), {"bad.yaml:4:", "reflectance must be at most 1"});
  check_refused(color("-0.5"), {"bad.yaml:4:", ">= 0"});
  check_refused(color(".nan"), {"bad.yaml:4:", "error: "});
  check_refused(color("red"), {"bad.yaml:4:", "unknown texture 'red'"});
}

TEST_CASE("film, budget and output") {
  check_refused(config_with("film: { width: 0 }\n"), {"bad.yaml:5:16: error: ", ">= 1"});
  check_refused(config_with("film: { height: -3 }\n"), {"bad.yaml:5:17: error: ", ">= 1"});
  check_refused(config_with("film: { width: 1000000000, height: 1000000000 }\n"),
                {"bad.yaml:5:16: error: ", "<= 32768"});
  check_refused(config_with("film: { width: 32768, height: 32768 }\n"),
                {"bad.yaml:5:7: error: ", "32768 x 32768", "pixels"});
  check_refused(config_with("film: { tile: 0 }\n"), {"bad.yaml:5:15: error: ", ">= 1"});
  check_refused(config_with("film: { filter: { type: box, radius: 1e9 } }\n"),
                {"bad.yaml:5:38: error: ", "radius must be"});
  check_refused(config_with("integrator: { type: path, max_depth: 99999999 }\n"),
                {"bad.yaml:5:38: error: "});
  check_refused(config_with("output: { image: picture.jpg }\n"), {"bad.yaml:5:18", ".exr"});
  const auto budget = [](const std::string& text) {
    return "scene: { sensor: perspective }\n" + text + "\n";
  };
  check_refused(budget(""), {"bad.yaml:1:1: error: ", "'budget'", "spp or seconds"});
  check_refused(budget("budget: {}"), {"bad.yaml:2:9: error: ", "either 'spp' or 'seconds'"});
  check_refused(budget("budget: { spp: 1, seconds: 2 }"), {"either 'spp' or 'seconds'"});
  check_refused(budget("budget: 16"), {"bad.yaml:2:9: error: ", "'spp'"});
  check_refused(budget("budget: { spp: 0 }"), {"bad.yaml:2:16: error: ", ">= 1"});
  check_refused(budget("budget: { spp: 9223372036854775808 }"), {"bad.yaml:2:16: error: "});
  check_refused(budget("budget: { spp: 4294967295 }"), {"bad.yaml:2:16: error: "});
  check_refused(budget("budget: { seconds: 0 }"), {"bad.yaml:2:20: error: ", "> 0"});
  check_refused(budget("budget: { seconds: .inf }"), {"bad.yaml:2:20: error: ", "finite"});
}

TEST_CASE("unknown plugins") {
  check_refused(config_with("sampler: sobbol\n"), {"bad.yaml:5:10: error: ", "'sobol'"});
  check_refused(config_with("sampler: { type: sobbol }\n"), {"bad.yaml:5:18: error: "});
  check_refused(config_with("integrator: { max_depth: 3 }\n"),
                {"bad.yaml:5:13: error: ", "'type'"});
  check_refused(config_with_shape("{ type: qaud }"), {"bad.yaml:4:15: error: ", "'quad'"});
  check_refused(config_with("sampler: diffuse\n"), {"bad.yaml:5:10: error: ", "unknown sampler"});
}

}  // namespace
}  // namespace pharos::testing
