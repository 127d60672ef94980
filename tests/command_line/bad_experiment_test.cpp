// Experiment files that cannot be run.

#include <limits>

#include <doctest/doctest.h>

#include <pharos/core/image.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

constexpr const char* kRender = R"(scene:
  shapes: [{ type: sphere, material: diffuse }]
  sensor: { type: perspective }
film: { width: 8, height: 8 }
integrator: { type: path }
budget: { spp: 1 }
)";

/// A valid experiment of eight lines. Line `line` is replaced by the given text (0: no line is
/// replaced), and `more` is added from line 9 on.
Mistake experiment(int line, const std::string& text, const std::string& more = "") {
  std::vector<std::string> lines{"title: Wrong",
                                 "scenes:",
                                 "  - { name: ball, config: render.yaml }",
                                 "methods:",
                                 "  - { name: one, settings: { sampler: independent } }",
                                 "budget: { spp: 4 }",
                                 "reference: { spp: 8 }",
                                 "cache: cache"};
  if (line > 0) lines[static_cast<std::size_t>(line) - 1] = text;
  std::string yaml;
  for (const std::string& each : lines) yaml += each + "\n";
  return {.arguments = "experiment bad.yaml", .prepare = [yaml, more](const ScratchFolder& folder) {
            folder.write("bad.yaml", yaml + more);
            folder.write("render.yaml", kRender);
          }};
}

TEST_CASE("experiments: keys and values") {
  check_refused(experiment(1, "titel: Wrong"), {"bad.yaml:1:1: error: ", "did you mean 'title'?"});
  check_refused(experiment(6, "budget: {}"), {"bad.yaml:6:9: error: ", "'spp' or 'seconds'"});
  check_refused(experiment(6, "budget: { spp: 4, seconds: 1 }"), {"bad.yaml:6:9: error: "});
  check_refused(experiment(6, "# none"), {"'budget'"});
  check_refused(experiment(8, "seeds: 0"), {"bad.yaml:8:8: error: ", "seeds must be >= 1"});
  check_refused(experiment(8, "baseline: two"),
                {"bad.yaml:8:11: error: ", "one of 'one', found 'two'"});
  check_refused(experiment(8, "settings: 3"), {"bad.yaml:8:11: error: ", "a mapping"});
  check_refused(experiment(8, "images: most"), {"bad.yaml:8:9: error: "});
}

TEST_CASE("experiments: scenes and methods") {
  check_refused(experiment(2, "scenes: []", ""), {"bad.yaml"});
  check_refused(experiment(3, "  - { name: ball, config: rendr.yaml }"),
                {"rendr.yaml", "did you mean 'render.yaml'?"});
  check_refused(experiment(3, "  - { name: ball, config: rendr.yaml, optional: true }"),
                {"bad.yaml:3:3: error: ", "all scenes are optional"});
  check_refused(experiment(3, "  - { name: ball, config: render.yaml, budget: {} }"),
                {"bad.yaml:3:48: error: ", "'spp' or 'seconds'"});
  check_refused(experiment(3, "  - { name: a/b, config: render.yaml }"),
                {"bad.yaml:3:13: error: ", "letters, digits"});
  check_refused(experiment(3, "  - { name: .., config: render.yaml }"), {"bad.yaml:3:13: error: "});
  check_refused(experiment(3, "  - { config: render.yaml }"), {"bad.yaml:3:", "'name'"});
  check_refused(experiment(5, "  - { name: one }\n  - { name: one }"),
                {"bad.yaml:6:5: error: ", "'one' stands twice in 'methods'"});
  check_refused(experiment(5, "  - { name: one, settings: { smapler: sobol } }"),
                {"bad.yaml:5:30: error: ", "did you mean 'sampler'?"});
  check_refused(experiment(5, "  - { name: one, settings: { sampler: sobbol } }"),
                {"bad.yaml:5:39: error: ", "did you mean 'sobol'?"});
  check_refused(experiment(5, "  - { name: one, settings: { film: { width: 9 } } }"),
                {"bad.yaml:5:", "8 x 8", "9 x 8"});
}

TEST_CASE("experiments: references") {
  check_refused(experiment(7, "# none"), {"bad.yaml:3:5: error: ", "there is no reference"});
  check_refused(experiment(7, "reference: { image: none.exr }"),
                {"bad.yaml:7:21: error: ", "none.exr"});
  check_refused(experiment(7, "reference: { spp: 9 }"), {"bad.yaml:7:12: error: ", "multiple"});
  check_refused(experiment(7, "reference: { spp: 9, parts: 3 }"),
                {"bad.yaml:7:29: error: ", "even"});
  check_refused(experiment(7, "reference: { spp: 8, image: render.yaml }"),
                {"bad.yaml:7:12: error: ", "found both"});
  check_refused(experiment(7, "reference: { spp: 8, settings: { integrator: { max_dept: 3 } } }"),
                {"bad.yaml:7:", "'max_depth'"});
  check_refused(experiment(7, "reference: { image: render.yaml }"), {"render.yaml"});
}

TEST_CASE("experiments: images that cannot be a reference") {
  const auto with_image = [](int edge, float value) {
    Mistake mistake = experiment(7, "reference: { image: given.exr }");
    mistake.prepare = [edge, value, prepare = mistake.prepare](const ScratchFolder& folder) {
      prepare(folder);
      Image image(edge, edge, {"R", "G", "B"});
      image.set_rgb(0, 0, Rgb(value));
      write_exr(image, folder.path() / "given.exr");
    };
    return mistake;
  };
  check_refused(with_image(9, 1), {"given.exr: error: ", "8 x 8", "9 x 9"});
  check_refused(with_image(8, std::numeric_limits<float>::quiet_NaN()),
                {"given.exr: error: ", "NaN or infinite"});
}

TEST_CASE("experiments: the command") {
  check_refused(Mistake{.arguments = "experiment"}, {"config"});
  check_refused(Mistake{.arguments = "experiment none.yaml"}, {"none.yaml"});
}

}  // namespace
}  // namespace pharos::testing
