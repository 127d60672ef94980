// Presets that a config names.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/config/node.h>
#include <pharos/rendering/presets.h>

#include "renders.h"

namespace pharos::testing {
namespace {

/// Returns a config with settings for its integrator.
std::string cornell(const std::string& integrator) {
  return fmt::format(
      "scene: {}/cornell-box/scene.yaml\nintegrator: {{ {} }}\nbudget: {{ spp: 1 }}\n",
      PHAROS_SCENES, integrator);
}

std::string resolved(const std::string& yaml) {
  return to_yaml(config_from(yaml).resolved);
}

TEST_CASE("presets: the name of a preset gives the same config as laying it below") {
  for (const auto& entry : find_presets(registry())) {
    const std::string& name = entry.first;
    CAPTURE(name);
    const ConfigNode preset = read_config(entry.second);
    const bool states_type = preset.find("integrator")->find("type") != nullptr;
    const std::string own = states_type ? "max_depth: 7" : "type: path, max_depth: 7";
    const ConfigNode over = parse_yaml(cornell(own), "over");
    const LoadedConfig below = build_render_config(merged(preset, over), registry());
    CHECK(resolved(cornell(own + ", guiding: " + name)) == to_yaml(below.resolved));
  }
}

TEST_CASE("presets: those of the project and of modules elsewhere are found") {
  const auto presets = find_presets(registry());
  CHECK(presets.count("focal") == 1);
  CHECK(presets.count("contract-stub") == 1);
  CHECK(resolved(cornell("type: path, guiding: contract-stub")).find("stub_direction") !=
        std::string::npos);
}

TEST_CASE("presets: roulette and splitting, alone and with guides") {
  for (const char* name : {"adrrs", "robust-adrrs", "ears", "robust-ears"}) {
    CAPTURE(name);
    const LoadedConfig loaded = config_from(cornell(fmt::format("guiding: {}", name)));
    const Integrator& integrator = *loaded.config.integrator;
    REQUIRE(integrator.learned_termination() != nullptr);
    CHECK(integrator.training()->images == TrainingImages::combine);
    const bool is_guided = std::string(name).find("robust") == 0;
    CHECK((integrator.guiding() != nullptr) == is_guided);
  }
}

}  // namespace
}  // namespace pharos::testing
