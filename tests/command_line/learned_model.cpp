#include "learned_model.h"

#include <mutex>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace pharos::testing {

std::string box_scene() {
  return R"(shapes:
  - { type: box, flip_normals: true, emitter: { type: area, radiance: 1 }, to_world: { scale: [2, 1, 1] } }
  - { type: sphere, radius: 0.5 }
sensor: { type: perspective, to_world: { look_at: { origin: [-1.8, 0.2, 0.1], target: [0, 0, 0], up: [0, 1, 0] } } }
)";
}

std::string training_config(const std::string& learner) {
  return fmt::format(
      "scene: box.yaml\nfilm: {{ width: 24, height: 16 }}\nbudget: {{ spp: 8 }}\n"
      "integrator:\n  type: path\n  max_depth: 4\n  guiding:\n    learner: {}\n"
      "    guider: {}\n    training: {{ iterations: 2 }}\n"
      "output: {{ model: box.model, png: false }}\n",
      learner, learner);
}

void write_learned_model(const ScratchFolder& folder) {
  folder.write("box.yaml", box_scene());
  folder.write("train.yaml", training_config("stub_segments"));
  // The model is learned only once, because the result does not depend on when it is learned.
  static const ScratchFolder once;
  static std::once_flag learned;
  std::call_once(learned, [] {
    once.write("box.yaml", box_scene());
    once.write("train.yaml", training_config("stub_segments"));
    REQUIRE(run_pharos("render train.yaml -q", once.path(), kStandIns).exit_code == 0);
  });
  std::filesystem::copy_file(once.path() / "box.model", folder.path() / "box.model");
}

}  // namespace pharos::testing
