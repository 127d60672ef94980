#include <algorithm>

#include <fmt/format.h>

#include <pharos/experiments/runner/entry_names.h>
#include <pharos/experiments/runner/experiment_config.h>

namespace pharos {
namespace {

bool is_even(std::uint32_t n) {
  return n % 2 == 0;
}

/// Whether a name is that of a method: the reference has its own place among the images.
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

/// What no single parameter can check.
void check_together(const ExperimentConfig& config, const ConfigNode& root) {
  names_of(config.scenes, root, "scenes");
  const std::vector<std::string> methods = names_of(config.methods, root, "methods");
  check_budget(config.budget, *root.find("budget"));
  if (!config.baseline.empty()) check_baseline(config.baseline, methods, "method", root);
  check_reference(config.reference, root.find("reference"));
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

}  // namespace

void ReferenceSettings::describe(Schema<ReferenceSettings>& s) {
  s.field("image", &ReferenceSettings::image, "Image file to measure against");
  s.field("spp", &ReferenceSettings::spp, "Samples a pixel, if it is to be rendered");
  s.field("parts", &ReferenceSettings::parts,
          "Independent renders it is made of: what is finished is kept, and their difference tells "
          "the reference's own error")
      .at_least(2)
      .at_most(1024)
      .check("even", is_even);
  s.field("settings", &ReferenceSettings::settings, "Laid over the scene's config");
}

void ExperimentScene::describe(Schema<ExperimentScene>& s) {
  s.field("name", &ExperimentScene::name, "Name in tables")
      .required()
      .check(kEntryNameRule, is_entry_name);
  s.field("config", &ExperimentScene::config, "Render config").required();
  s.field("settings", &ExperimentScene::settings, "Laid over it");
  s.field("reference", &ExperimentScene::reference, "Instead of the experiment's");
  s.field("budget", &ExperimentScene::budget, "Instead of the experiment's");
}

void ExperimentMethod::describe(Schema<ExperimentMethod>& s) {
  s.field("name", &ExperimentMethod::name, "Name in tables")
      .required()
      .check(std::string(kEntryNameRule) + ", not 'reference'", is_method_name);
  s.field("config", &ExperimentMethod::config,
          "A config such as a preset, laid over every scene's");
  s.field("settings", &ExperimentMethod::settings, "Laid over both");
}

void ExperimentConfig::describe(Schema<ExperimentConfig>& s) {
  s.field("title", &ExperimentConfig::title, "Heading of the report");
  s.field("description", &ExperimentConfig::description, "What is asked, in a sentence or two");
  s.field("scenes", &ExperimentConfig::scenes, "What is rendered").required();
  s.field("methods", &ExperimentConfig::methods, "What is compared").required();
  s.field("settings", &ExperimentConfig::settings, "Laid over all scenes' configs");
  s.field("budget", &ExperimentConfig::budget, "Of every run: spp or seconds").required();
  s.field("seeds", &ExperimentConfig::seeds, "Runs of each method on each scene")
      .at_least(1)
      .at_most(10000);
  s.field("first_seed", &ExperimentConfig::first_seed, "Seed of the first run").at_least(0);
  s.field("baseline", &ExperimentConfig::baseline,
          "Method that ratios are to; by default the first");
  s.field("reference", &ExperimentConfig::reference, "What errors are measured against");
  s.field("images", &ExperimentConfig::images, "Whose images are kept: the first seed's or all");
  s.field("output", &ExperimentConfig::output,
          "Folder, relative to the current one; by default the file's name");
  s.field("cache", &ExperimentConfig::cache,
          "Folder of rendered references; by default pharos/references in the user's cache");
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
  const std::string name = path.stem().string();
  config.source = std::filesystem::absolute(path).lexically_normal();
  if (config.title.empty()) config.title = name;
  if (config.baseline.empty()) config.baseline = config.methods.front().name;
  if (config.output.empty()) config.output = name;
  return config;
}

}  // namespace pharos
