// Checks of made-up blocks of YAML.

#include "config_blocks.h"

#include <string>

#include <doctest/doctest.h>

namespace pharos::docs {
namespace {

constexpr const char* kExperiment = R"(scenes:
  - { name: box, config: ../cornell-box.yaml, settings: { film: { width: 8, height: 8 } } }
methods:
  - { name: one, settings: { sampler: independent } }
reference: { spp: 8 }
)";

constexpr const char* kConvergence =
    "integrands: [{ name: a, integrand: { type: edge, angles: [30] } }]\n";

void check_right(const std::string& yaml) {
  CAPTURE(yaml);
  const Workbench bench;
  const BlockCheck check = check_block(yaml, bench);
  CHECK(check.depth == Depth::validated);
  CHECK(check.problem == "");
}

void check_wrong(const std::string& yaml, const std::string& says) {
  CAPTURE(yaml);
  const Workbench bench;
  const BlockCheck check = check_block(yaml, bench);
  CAPTURE(check.problem);
  CHECK(check.problem.find(says) != std::string::npos);
}

void check_incomplete(const std::string& yaml, Depth depth) {
  CAPTURE(yaml);
  const Workbench bench;
  const BlockCheck check = check_block(yaml, bench);
  CHECK(check.depth == depth);
  CHECK(check.problem == "");
}

TEST_CASE("blocks: whole configs") {
  check_right("extends: base.yaml\nscene: ../scenes/cornell-box/scene.yaml\nbudget: { spp: 4 }\n");
  check_right("extends: [cornell-box.yaml, presets/focal.yaml]   # or …\n");
  check_wrong("extends: base.yaml\nscene: ../scenes/cornel-box/scene.yaml\n", "cornel-box");
  check_wrong("extends: bass.yaml\nscene: ../scenes/cornell-box/scene.yaml\n", "'base.yaml'");
  check_wrong("extends: cornell-box.yaml\nfilm: { widht: 3 }\n", "'width'");
  check_wrong("extends: cornell-box.yaml\nbudget: { spp: 0 }\n", "spp");
}

TEST_CASE("blocks: parts of configs, at the place where they belong") {
  check_right("sampler: { type: sobol }\nintegrator: { max_depth: 3 }\n");
  check_right("integrator:\n  guiding: { learner: focal, guider: focal }\n");
  check_right("guiding: { learner: focal, guider: focal }\n");
  check_right("mixing: { type: fixed, unguided_fraction: 0.25 }\ntraining: { iterations: 3 }\n");
  check_right("max_depth: 5\n");
  check_right("budget: { seconds: 20 }\noutput: { aovs: [albedo] }\n");
  check_right("materials: { matt: diffuse }\nshapes: [{ type: sphere, material: matt }]\n");
  check_wrong("integrator:\n  guiding: { learner: focall, guider: focal }\n", "'focal'");
  check_wrong("guiding: { learner: focal, guider: focal, mixin: fixed }\n", "'mixing'");
  check_wrong("mixing: { type: fixed, unguided: 0.25 }\n", "unguided");
  check_wrong("training: { iteration: 3 }\n", "'iterations'");
  check_wrong("max_dept: 5\n", "max_dept");
  check_wrong("shapes: [{ type: sphere, material: matt }]\n", "matt");
}

TEST_CASE("blocks: experiments and measurements of convergence") {
  check_right(std::string(kExperiment) + "budget: { spp: 4 }\n");
  check_right(kConvergence);
  check_wrong(kExperiment, "'budget'");
  check_wrong(std::string(kExperiment) + "budget: { spp: 4 }\nsettings: { film: { with: 8 } }\n",
              "'width'");
  check_wrong(std::string(kConvergence) + "realisations: 3\n", "'realizations'");
}

TEST_CASE("blocks that leave something out") {
  check_incomplete("integrator:\n  guiding: { learner: …, guider: … }\n", Depth::parsed);
  check_incomplete("output: { model: ... }\n", Depth::parsed);
  check_incomplete("guiding: { learner: NAME, guider: NAME }\n", Depth::parsed);
  check_incomplete("shapes: [ { type: sphere }, …\n", Depth::skipped);
  check_wrong("shapes: [ { type: sphere }\n", "block:");
  check_incomplete("type: sphere\nradius: 2\n", Depth::parsed);
  check_wrong("- a\n- b\n", "no mapping");
  check_right("max_depth: 5       # or …\n");
}

TEST_CASE("blocks that are saved as files") {
  const Workbench bench;
  save_named_blocks(
      parse_page("Save it as `configs/mine.yaml`:\n\n```yaml\nextends: cornell-box.yaml\n```\n"
                 "As `configs/cornell-box.yaml`:\n\n```yaml\nseed: 3\n```\n")
          .fences,
      bench);
  CHECK(bench.run("validate configs/mine.yaml").exit_code == 0);
  CHECK(bench.run("validate configs/cornell-box.yaml").exit_code == 0);
}

}  // namespace
}  // namespace pharos::docs
