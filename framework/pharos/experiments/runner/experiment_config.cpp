#include <algorithm>

#include <fmt/format.h>

#include <pharos/core/user_cache.h>
#include <pharos/experiments/runner/entry_names.h>
#include <pharos/experiments/runner/experiment_config.h>

namespace pharos {
namespace {

bool is_even(std::uint32_t n) {
  return n % 2 == 0;
}

/// Returns whether a name is a valid method name. The name "reference" is reserved for the
/// reference among the images.
bool is_method_name(const std::string& name) {
  return is_entry_name(name) && name != "reference";
}

void check_reference(const ReferenceSettings& reference, const ConfigNode* node) {
  if (!reference.image.empty() && reference.spp > 0) {
    node->fail("expected either 'image' or 'spp', found both");
  }
  if (reference.spp > 0 && reference.spp % reference.parts != 0) {
    node->fail(fmt::format("expected 'spp' to be a multiple of 'parts', found {} and {}",
                           reference.spp, reference.parts));
  }
  if (reference.image.empty()) return;
  const std::string problem = file_problem(reference.image);
  if (!problem.empty()) {
    node->find("image")->fail(fmt::format("'{}': {}", reference.image.string(), problem));
  }
}

void check_budget(const Budget& budget, const ConfigNode& node) {
  if (budget.spp.has_value() == budget.seconds.has_value()) {
    node.fail("expected either 'spp' or 'seconds'");
  }
}

/// Makes the checks that concern several parameters.
void check_together(const ExperimentConfig& config, const ConfigNode& root) {
  names_of(config.scenes, root, "scenes");
  const std::vector<std::string> methods = names_of(config.methods, root, "methods");
  check_budget(config.budget, *root.find("budget"));
  if (!config.baseline.empty()) check_baseline(config.baseline, methods, "method", root);
  check_reference(config.reference, root.find("reference"));
  for (std::size_t i = 0; i < config.methods.size(); ++i) {
    const ConfigNode& node = root.find("methods")->items()[i];
    if (config.methods[i].budget) check_budget(*config.methods[i].budget, *node.find("budget"));
  }
  for (std::size_t i = 0; i < config.scenes.size(); ++i) {
    const ConfigNode& node = root.find("scenes")->items()[i];
    check_reference(config.scenes[i].reference, node.find("reference"));
    if (config.scenes[i].budget) check_budget(*config.scenes[i].budget, *node.find("budget"));
    if (!config.scenes[i].reference.given() && !config.reference.given()) {
      node.fail(
          "there is no reference: state 'reference' here or for all scenes, with 'image' or "
          "'spp'");
    }
  }
}

void leave_out_absent(ExperimentConfig& config, const ConfigNode& root) {
  const auto absent = std::stable_partition(
      config.scenes.begin(), config.scenes.end(), [](const ExperimentScene& scene) {
        return !scene.optional || std::filesystem::exists(scene.config);
      });
  config.left_out.assign(absent, config.scenes.end());
  config.scenes.erase(absent, config.scenes.end());
  if (config.scenes.empty()) {
    root.find("scenes")->fail("all scenes are optional, and the config of none of them exists");
  }
}

}  // namespace

void ReferenceSettings::describe(Schema<ReferenceSettings>& s) {
  s.field("image", &ReferenceSettings::image, "Image file of the reference");
  s.field("spp", &ReferenceSettings::spp, "Samples per pixel of a rendered reference");
  s.field("parts", &ReferenceSettings::parts,
          "Number of independent renders; finished ones are kept, and their difference gives the "
          "reference's own error")
      .at_least(2)
      .at_most(1024)
      .check("even", is_even);
  s.field("settings", &ReferenceSettings::settings, "Values that override the scene's config");
}

void ExperimentScene::describe(Schema<ExperimentScene>& s) {
  s.field("name", &ExperimentScene::name, "Name in tables")
      .required()
      .check(kEntryNameRule, is_entry_name);
  s.field("config", &ExperimentScene::config, "Render config").required();
  s.field("settings", &ExperimentScene::settings, "Values that override the render config");
  s.field("reference", &ExperimentScene::reference, "Replaces the experiment's reference");
  s.field("budget", &ExperimentScene::budget, "Replaces the experiment's budget");
  s.field("optional", &ExperimentScene::optional,
          "Leave the scene out if its config does not exist");
}

void ExperimentMethod::describe(Schema<ExperimentMethod>& s) {
  s.field("name", &ExperimentMethod::name, "Name in tables")
      .required()
      .check(std::string(kEntryNameRule) + ", not 'reference'", is_method_name);
  s.field("config", &ExperimentMethod::config,
          "Config such as a preset; its values override every scene's config");
  s.field("settings", &ExperimentMethod::settings, "Values that override both configs");
  s.field("seeds", &ExperimentMethod::seeds,
          "Runs on each scene, if there shall be fewer than of other methods")
      .at_least(1);
  s.field("budget", &ExperimentMethod::budget,
          "Replaces the budgets of the experiment and of its scenes");
}

void ExperimentConfig::describe(Schema<ExperimentConfig>& s) {
  s.field("title", &ExperimentConfig::title, "Heading of the report");
  s.field("description", &ExperimentConfig::description,
          "Question of the experiment, in a sentence or two");
  s.field("scenes", &ExperimentConfig::scenes, "Scenes to render").required();
  s.field("methods", &ExperimentConfig::methods, "Methods to compare").required();
  s.field("settings", &ExperimentConfig::settings, "Values that override all scenes' configs");
  s.field("budget", &ExperimentConfig::budget, "Budget of every run: spp or seconds").required();
  s.field("seeds", &ExperimentConfig::seeds, "Runs of each method on each scene")
      .at_least(1)
      .at_most(10000);
  s.field("first_seed", &ExperimentConfig::first_seed, "Seed of the first run").at_least(0);
  s.field("baseline", &ExperimentConfig::baseline,
          "Method in the denominator of ratios; by default the first");
  s.field("reference", &ExperimentConfig::reference, "Reference that errors are measured against");
  s.field("images", &ExperimentConfig::images,
          "Runs whose images are kept: runs of the first seed or all");
  s.field("time_limit", &ExperimentConfig::time_limit,
          "A run that takes longer is ended and counts as failed")
      .unit("s")
      .above(0);
  s.field("memory_limit", &ExperimentConfig::memory_limit,
          "Address space of a run or a reference; one that needs more fails")
      .unit("GiB")
      .above(0)
      .at_most(1e9);
  s.field("output", &ExperimentConfig::output,
          "Folder, relative to the current one; by default the file's name");
  s.field("cache", &ExperimentConfig::cache,
          "Folder of rendered references; by default pharos/references in the user's cache");
}

ChildLimits ExperimentConfig::limits() const {
  constexpr double kGibibyte = 1 << 30;
  ChildLimits limits{.seconds = time_limit, .bytes = {}};
  if (memory_limit) limits.bytes = *memory_limit * kGibibyte;
  return limits;
}

std::filesystem::path ExperimentConfig::reference_cache() const {
  return cache.empty() ? user_cache_folder() / "references" : cache;
}

ExperimentConfig load_experiment(const std::filesystem::path& path,
                                 const std::vector<std::string>& overrides,
                                 const Registry& registry) {
  ConfigNode node = read_config(path);
  for (const std::string& assignment : overrides) apply_override(node, assignment);
  BuildContext context{registry};
  ConfigNode resolved;
  auto config = Value<ExperimentConfig>::read(node, context, resolved);
  check_together(config, node);
  leave_out_absent(config, node);
  const std::string name = path.stem().string();
  config.source = std::filesystem::absolute(path).lexically_normal();
  if (config.title.empty()) config.title = name;
  if (config.baseline.empty()) config.baseline = config.methods.front().name;
  if (config.output.empty()) config.output = name;
  return config;
}

}  // namespace pharos
