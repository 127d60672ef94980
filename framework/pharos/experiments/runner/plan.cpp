#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/experiments/metrics/pixel_pair.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/plan.h>
#include <pharos/rendering/scene_import.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// Returns a scene's config with the experiment's settings and the scene's own settings applied. Of
/// the output settings, only the exposure is kept, which metrics use.
ConfigNode scene_config(const ExperimentConfig& experiment, const ExperimentScene& scene,
                        const Registry& registry) {
  ConfigNode node = read_config_or_scene(scene.config, registry);
  const ConfigNode output = node.take("output");
  if (const ConfigNode* exposure = output.find("exposure")) {
    ConfigNode kept = ConfigNode::mapping();
    kept.set("exposure", *exposure);
    node.set("output", std::move(kept));
  }
  return merged(merged(std::move(node), experiment.settings), scene.settings);
}

ConfigNode budget_node(const Budget& budget) {
  ConfigNode node = ConfigNode::mapping();
  if (budget.spp) node.set("spp", ConfigNode::scalar(std::to_string(*budget.spp)));
  if (budget.seconds) node.set("seconds", ConfigNode::scalar(number_text(*budget.seconds)));
  return node;
}

void check_film(const FilmSettings& film, const PlannedReference& reference,
                const ConfigNode& config) {
  const PixelRect window = film.window();
  if (window.width() == reference.width && window.height() == reference.height) return;
  const ConfigNode* node = config.find("film");
  node->fail(
      fmt::format("a method must not change the size of the film: expected {} x {} as in the "
                  "reference, found {} x {}",
                  reference.width, reference.height, window.width(), window.height()));
}

PlannedCell plan_cell(const ExperimentConfig& experiment, const ConfigNode& scene,
                      const PlannedReference& reference, std::size_t scene_index,
                      std::size_t method_index, const Registry& registry) {
  PlannedCell cell{.scene = scene_index, .method = method_index};
  const ExperimentMethod& method = experiment.methods[method_index];
  cell.config = method.config.empty() ? scene : merged(scene, read_config(method.config));
  cell.config = merged(std::move(cell.config), method.settings);
  cell.config.set("budget",
                  budget_node(experiment.budget_of(experiment.scenes[scene_index], method)));
  LoadedConfig loaded = build_run(cell.config, experiment.first_seed, registry);
  check_film(loaded.config.film, reference, cell.config);
  loaded.resolved.take("seed");
  loaded.resolved.take("output");
  cell.text = to_yaml(loaded.resolved);
  cell.exposure = loaded.config.output.exposure;
  cell.build = build_key(loaded.resolved, registry);
  cell.key = content_key(
      fmt::format("{} {} {}", content_key(loaded), cell.build, loaded.config.output.exposure));
  cell.papers = std::move(loaded.papers);
  return cell;
}

PlannedReference plan_reference(const ReferenceSettings& settings, const ConfigNode& scene,
                                const Registry& registry) {
  PlannedReference reference{.file = settings.image, .config = merged(scene, settings.settings)};
  if (settings.spp > 0) reference.parts = settings.parts;
  // A reference file must have the size of the scene's images. Any budget is enough to determine
  // this size.
  reference.config.set("budget", budget_node({.spp = std::max(settings.spp / settings.parts, 1u)}));
  LoadedConfig loaded = build_run(reference.config, kReferenceSeed, registry);
  if (reference.parts > 0) {
    reference.key = content_key(content_key(loaded) + fmt::format(" in {}", reference.parts));
  }
  loaded.resolved.take("output");
  reference.build = build_key(loaded.resolved, registry);
  const PixelRect window = loaded.config.film.window();
  reference.width = window.width(), reference.height = window.height();
  if (!settings.image.empty()) {
    reference.key = pixels_key(read_reference(settings.image, reference.width, reference.height));
  }
  return reference;
}

}  // namespace

Image read_reference(const fs::path& file, int width, int height) {
  Image image = rgb_only(read_image(file), file.string());
  if (image.width() != width || image.height() != height) {
    throw InputError(
        fmt::format("{}: error: expected {} x {} pixels like the renders, found {} x {}",
                    file.string(), width, height, image.width(), image.height()));
  }
  const std::vector<float>& values = image.values();
  if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); })) {
    throw InputError(
        fmt::format("{}: error: a reference must not have NaN or infinite pixels", file.string()));
  }
  return image;
}

LoadedConfig build_run(const ConfigNode& config, std::uint64_t seed, const Registry& registry) {
  ConfigNode node = config;
  node.set("seed", ConfigNode::scalar(std::to_string(seed)));
  return build_render_config(node, registry);
}

ExperimentPlan plan_experiment(const ExperimentConfig& experiment, const Registry& registry) {
  ExperimentPlan plan;
  for (std::size_t s = 0; s < experiment.scenes.size(); ++s) {
    const ExperimentScene& scene = experiment.scenes[s];
    const ConfigNode config = scene_config(experiment, scene, registry);
    plan.references.push_back(plan_reference(
        scene.reference.given() ? scene.reference : experiment.reference, config, registry));
    for (std::size_t m = 0; m < experiment.methods.size(); ++m) {
      plan.cells.push_back(plan_cell(experiment, config, plan.references[s], s, m, registry));
    }
  }
  return plan;
}

}  // namespace pharos
