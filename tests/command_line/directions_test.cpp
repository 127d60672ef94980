// `pharos directions` from the command line.

#include <string>

#include <doctest/doctest.h>

#include <pharos/core/image.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

/// A floor under a light that is partly covered by a slanted board.
constexpr const char* kBoard = R"(
scene:
  shapes:
    - { type: quad, to_world: [ { scale: 4 }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ] }
    - { type: quad, to_world: [ { rotate: { axis: [1, 0, 0], degrees: 90 } }, { rotate: { axis: [0, 1, 0], degrees: 30 } }, { translate: [0.5, 1, 0] } ] }
    - { type: quad, to_world: [ { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [0, 3, 0] } ], emitter: { type: area, radiance: 8 } }
  sensor: { type: perspective, fov: 40, to_world: { look_at: { origin: [0, 2, -5], target: [0, 0, 0], up: [0, 1, 0] } } }
film: { width: 48, height: 32, filter: box }
integrator: { type: path, light_selection: all }
budget: { spp: 64 }
)";

Mistake on_board(const std::string& arguments) {
  return {.arguments = "directions " + arguments,
          .prepare = [](const ScratchFolder& folder) { folder.write("board.yaml", kBoard); }};
}

TEST_CASE("directions: a picture for the lights of a scene, whatever its sampler") {
  for (const std::string sampler : {"sobol", "{ type: aligned, estimation: { block: 8 } }"}) {
    CAPTURE(sampler);
    const ScratchFolder folder;
    folder.write("board.yaml", kBoard + ("sampler: " + sampler + "\n"));
    const Outcome outcome = run_pharos(
        "directions --render board.yaml -o board.png --samples 1 --scale 2", folder.path());
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(outcome.err.find("light_position, branch 0") != std::string::npos);
    const std::string regions = sampler == "sobol" ? "of 6 regions" : "of 24 regions";
    CHECK(outcome.err.find(regions) != std::string::npos);
    const Image picture = read_image(folder / "board.png");
    CHECK(picture.width() == 96);
    CHECK(picture.height() == 64);
    CHECK(folder.file_count() == 2);
  }
}

TEST_CASE("directions: mistakes") {
  check_refused(on_board("-o board.png"), {"'render'"});
  check_refused(on_board("--render board.yaml"), {"'output'"});
  check_refused(on_board("--render board.yaml -o board.exr"), {"board.exr", ".png"});
  check_refused(on_board("--render board.yaml -o none/board.png"), {"none' does not exist"});
  check_refused(on_board("--render bord.yaml -o board.png"), {"bord.yaml", "board.yaml"});
  check_refused(on_board("--render board.yaml -o board.png --scale 0"), {"--scale 0: error: "});
}

}  // namespace
}  // namespace pharos::testing
