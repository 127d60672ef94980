// The progress bar of a render on a terminal.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "process.h"

namespace pharos::testing {
namespace {

/// A config with a time budget, so that each iteration lasts longer than the bar's redraw interval.
std::string timed_render(const std::string& integrator) {
  return fmt::format(
      "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 40, height: 30 }}\n"
      "budget: {{ seconds: 2 }}\noutput: {{ png: false }}\nintegrator: {}\n",
      PHAROS_SCENES, integrator);
}

TEST_CASE("the bar names the iteration of training, and then the final one") {
  const ScratchFolder folder;
  folder.write("box.yaml",
               timed_render("{ type: path, guiding: { learner: uniform, guider: uniform, "
                            "training: { iterations: 2 } } }"));
  const Outcome outcome = run_pharos_on_terminal("render box.yaml", folder.path());
  REQUIRE(outcome.exit_code == 0);
  const std::size_t first = outcome.out.find("training 1/3  [");
  const std::size_t second = outcome.out.find("training 2/3  [");
  const std::size_t last = outcome.out.find("rendering 3/3  [");
  REQUIRE(last != std::string::npos);
  CHECK(first < second);
  CHECK(second < last);
  // An iteration is not shown again after its end.
  CHECK(outcome.out.rfind("training 1/3") < second);
  CHECK(outcome.out.rfind("training 2/3") < last);
}

TEST_CASE("the bar of a render without training names no iteration and goes away") {
  const ScratchFolder folder;
  folder.write("box.yaml", timed_render("path"));
  const Outcome outcome =
      run_pharos_on_terminal("render box.yaml --set budget.seconds=0.5", folder.path());
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.find("[=") != std::string::npos);
  CHECK(outcome.out.find("rendering") == std::string::npos);
  const std::size_t taken_away = outcome.out.rfind("\r\x1b[K");
  const std::size_t report = outcome.out.find("box.exr: 40 x 30");
  REQUIRE(report != std::string::npos);
  CHECK(taken_away < report);
  CHECK(outcome.out.rfind("[=") < taken_away);
}

TEST_CASE("--quiet shows no bar") {
  const ScratchFolder folder;
  folder.write("box.yaml", timed_render("path"));
  const Outcome outcome =
      run_pharos_on_terminal("render box.yaml -q --set budget.seconds=0.3", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
}

}  // namespace
}  // namespace pharos::testing
