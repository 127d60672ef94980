// `pharos synthesize` from the command line. The test also covers the common properties of commands
// of modules: options from parameters, settings files, mistakes, stopping.

#include <algorithm>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include <pharos/core/image.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

constexpr const char* kQuick = "--points 64 --steps 20";

Mistake typed(const std::string& arguments) {
  return {.arguments = "synthesize " + arguments};
}

Mistake file(const std::string& text) {
  return {.arguments = "synthesize bad.yaml",
          .prepare = [=](const ScratchFolder& folder) { folder.write("bad.yaml", text); }};
}

/// Returns the points that `synthesize ARGUMENTS -o points.txt` writes.
std::string points_of(const std::string& arguments, const std::string& config = "") {
  const ScratchFolder folder;
  if (!config.empty()) folder.write("points.yaml", config);
  const Outcome outcome =
      run_pharos("synthesize " + arguments + " -o points.txt -q", folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(outcome.err.empty());
  return test::bytes_of(folder / "points.txt");
}

TEST_CASE("synthesize: points as text, the same from options and from a file") {
  const std::string text = points_of(std::string(kQuick) + " --directions 30,75 --seed 5");
  CHECK(std::count(text.begin(), text.end(), '\n') == 64);
  const std::string settings = "points: 64\nsteps: 20\ndirections: [30, 75]\nseed: 5\n";
  CHECK(points_of("points.yaml", settings) == text);
  CHECK(points_of("points.yaml --seed 6", settings) != text);
  CHECK(points_of("points.yaml --set seed=6", settings) ==
        points_of("points.yaml --seed 6", settings));
  CHECK(points_of("points.yaml --threads 3", settings) == text);
  CHECK(points_of("points.yaml --rule '{ radius: 0.4 }'", settings) != text);
}

TEST_CASE("synthesize: binary points and a picture") {
  const ScratchFolder folder;
  const Outcome outcome =
      run_pharos("synthesize --points 64 --steps 20 -o points.bin --picture points.png --size 100",
                 folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(outcome.err.find("64 points") != std::string::npos);
  CHECK(folder.file_count() == 2);
  CHECK(test::bytes_of(folder / "points.bin").size() > 64 * 4);
  const Image picture = read_image(folder / "points.png");
  CHECK(picture.height() == 100);
  CHECK(picture.width() > 200);
}

TEST_CASE("synthesize: it is told of with all other commands and plugins") {
  const ScratchFolder folder;
  CHECK(run_pharos("--help", folder.path()).out.find("synthesize") != std::string::npos);
  CHECK(run_pharos("synthesize --help", folder.path()).out.find("--pair-step") !=
        std::string::npos);
  CHECK(run_pharos("plugins command", folder.path()).out.find("synthesize") != std::string::npos);
  check_refused(Mistake{.arguments = "synthesise"}, {"did you mean 'synthesize'?"});
}

TEST_CASE("synthesize: mistakes") {
  check_refused(typed(""), {"'output'", "'picture'"});
  check_refused(typed("-o points.csv"), {"points.csv", ".txt or .bin"});
  check_refused(typed("--picture points.jpg"), {"points.jpg", ".png"});
  check_refused(typed("-o none/points.txt"), {"none' does not exist"});
  check_refused(typed("-o a.txt --points 100"), {"--points 100: error: ", "power of two"});
  check_refused(typed("-o a.txt --points many"), {"--points many: error: ", "integer"});
  check_refused(typed("-o a.txt --directions 30,north"), {"--directions 30,north", "number"});
  check_refused(typed("-o a.txt --steps 0"), {"--steps 0: error: "});
  check_refused(typed("-o a.txt --pair-step 4"), {"--pair-step 4: error: ", "divisor of 45"});
  check_refused(typed("-o a.txt --pairs 4"), {"--pairs"});
  check_refused(typed("-o a.txt --spectrum 0 --wasserstein 0"), {"positive weight"});
  check_refused(typed("-o a.txt --rule '{ radios: 1 }'"), {"did you mean 'radius'?"});
  check_refused(typed("-o a.txt --mask '[{ x: 0, y: 0 }]'"), {"(0, 0)"});
  check_refused(typed("-o a.txt --set step"), {"KEY=VALUE"});
  check_refused(typed("--shipped sets --steps 5"), {"settings of their own"});
  check_refused(typed("none.yaml"), {"none.yaml"});
  check_refused(file("poins: 64\noutput: a.txt\n"),
                {"bad.yaml:1:1: error: ", "did you mean 'points'?"});
  check_refused(file("output: a.txt\nmask: [{ x: 1 }]\n"), {"bad.yaml:2:8: error: ", "'y'"});
}

TEST_CASE("synthesize: stopped, it leaves nothing behind") {
  const ScratchFolder folder;
  const Outcome outcome = interrupt_pharos("synthesize --points 16384 --steps 100000 -o points.txt",
                                           folder.path(), 1.5, "INT");
  CHECK(outcome.exit_code == 130);
  CHECK(folder.file_count() == 0);
}

}  // namespace
}  // namespace pharos::testing
