// Bad input ends in one message with file, line and column, exit code 2, and nothing written.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "process.h"

namespace pharos::testing {
namespace {

/// Renders `text` as bad.yaml and checks that it fails with `expected` in its one-line message.
void check_refused(const std::string& text, const std::string& expected,
                   const std::string& options = "") {
  const ScratchFolder folder;
  folder.write("bad.yaml", text);
  const Outcome outcome = run_pharos("render bad.yaml " + options, folder.path());
  CAPTURE(text);
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find(expected) != std::string::npos);
  CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
  CHECK(folder.file_count() == 1);
}

std::string with(const std::string& more) {
  return fmt::format("scene: {}/cornell-box/scene.yaml\nbudget: {{ spp: 1 }}\n{}", PHAROS_SCENES,
                     more);
}

std::string with_shape(const std::string& shape) {
  return "scene:\n  sensor: perspective\n  shapes:\n    - " + shape + "\nbudget: { spp: 1 }\n";
}

TEST_CASE("misspelt keys") {
  check_refused(with("smapler: sobol\n"), "bad.yaml:3:1: error: ");
  check_refused(with("smapler: sobol\n"), "did you mean 'sampler'?");
  check_refused(with("film: { widht: 3 }\n"), "bad.yaml:3:9: error: ");
  check_refused(with("film: { widht: 3 }\n"), "'width'");
  check_refused(with("integrator: { type: path, max_dept: 3 }\n"), "'max_depth'");
  check_refused(with_shape("{ type: quad, materail: diffuse }"), "'material'");
}

TEST_CASE("duplicate keys") {
  check_refused(with("seed: 1\nseed: 2\n"), "bad.yaml:4:1: error: ");
  check_refused(with("film: { width: 3, width: 4 }\n"), "bad.yaml:3:19: error: ");
}

TEST_CASE("mistyped values") {
  check_refused(with("seed: many\n"), "bad.yaml:3:7: error: ");
  check_refused(with("film: { width: [1, 2] }\n"), "bad.yaml:3:16: error: ");
  check_refused(with("film: 12\n"), "bad.yaml:3:7: error: ");
  check_refused(with("output: { png: perhaps }\n"), "bad.yaml:3:16: error: ");
  check_refused(with("integrator: { type: path, mis: ballance }\n"), "'balance'");
}

TEST_CASE("values out of range") {
  check_refused(with("film: { width: 0 }\n"), "bad.yaml:3:16: error: ");
  check_refused(with("film: { width: 0 }\n"), ">= 1");
  check_refused(with("integrator: { type: path, max_depth: 99999999 }\n"),
                "bad.yaml:3:38: error: ");
  check_refused(with("output: { image: picture.jpg }\n"), ".exr");
}

TEST_CASE("unknown plugins") {
  check_refused(with("sampler: sobbol\n"), "bad.yaml:3:10: error: ");
  check_refused(with("sampler: sobbol\n"), "'sobol'");
  check_refused(with("sampler: { type: sobbol }\n"), "bad.yaml:3:18: error: ");
  check_refused(with("integrator: { max_depth: 3 }\n"), "bad.yaml:3:13: error: ");
  check_refused(with_shape("{ type: qaud }"), "'quad'");
}

TEST_CASE("what does not fit together") {
  check_refused(with("").replace(with("").find("{ spp: 1 }"), 10, "{ spp: 1, seconds: 2 }"),
                "either 'spp' or 'seconds'");
  check_refused("scene: { shapes: [] }\nbudget: { spp: 1 }\n", "no sensor");
  check_refused(with("integrator: { type: path, guiding: { } }\n"), "learner");
  check_refused(with_shape("{ type: quad, emitter: { type: constant } }"), "bad.yaml:4:");
}

TEST_CASE("missing and unusable files") {
  check_refused("scene: nowhere.yaml\nbudget: { spp: 1 }\n", "bad.yaml:1:8: error: ");
  check_refused("scene: /\nbudget: { spp: 1 }\n", "bad.yaml:1:8: error: ");
  check_refused(with_shape("{ type: mesh, file: nothing.obj }"), "nothing.obj");
  check_refused(with_shape("{ type: quad, material: { type: diffuse, reflectance: { type: bitmap, "
                           "file: nothing.png } } }"),
                "nothing.png");
  check_refused("extends: nowhere.yaml\n", "bad.yaml:1:10: error: ");
  check_refused("extends: bad.yaml\n", "bad.yaml:1:1: error: ");
  check_refused(with(""), "no-such-folder", "-o no-such-folder/x.exr");
}

TEST_CASE("broken YAML") {
  check_refused("scene: [1, 2\n", "bad.yaml:");
  check_refused("", "bad.yaml");
  check_refused("just a sentence\n", "bad.yaml:1:1: error: ");
}

TEST_CASE("overrides are checked like the rest") {
  check_refused(with(""), "--set", "--set film.widht=3");
  check_refused(with(""), "--set", "--set film.width=no");
  check_refused(with(""), "--set", "--set film.width");
}

TEST_CASE("a config that does not exist") {
  const ScratchFolder folder;
  folder.write("quick.yaml", "");
  const Outcome outcome = run_pharos("render quik.yaml", folder.path());
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("quick.yaml") != std::string::npos);
  CHECK(run_pharos("rendre quick.yaml", folder.path()).exit_code == 2);
  CHECK(run_pharos("", folder.path()).exit_code == 2);
}

}  // namespace
}  // namespace pharos::testing
