#include "config_blocks.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <regex>
#include <string_view>
#include <utility>

#include <pharos/core/error.h>
#include <pharos/experiments/runner/experiment.h>
#include <pharos/laboratory/laboratory_config.h>

namespace pharos::docs {
namespace {

namespace fs = std::filesystem;

constexpr auto kSceneKeys = std::to_array<std::string_view>(
    {"textures", "materials", "media", "shapes", "groups", "emitters", "medium"});
constexpr auto kGuidingKeys = std::to_array<std::string_view>(
    {"learner", "guider", "model", "methods", "mixing", "training"});
constexpr auto kIntegratorKeys =
    std::to_array<std::string_view>({"guiding", "max_depth", "next_event_estimation",
                                     "light_selection", "roulette", "roulette_depth"});

template <class Keys>
bool is_among(const Keys& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

bool has_one_of_scene(const ConfigNode& part) {
  return std::any_of(kSceneKeys.begin(), kSceneKeys.end(),
                     [&](std::string_view key) { return part.find(key) != nullptr; });
}

bool leaves_out(std::string_view text) {
  return text.find("…") != std::string_view::npos || text.find("...") != std::string_view::npos;
}

/// Whether a value is a name to be filled in by the reader, such as NAME.
bool is_blank_to_fill(const ConfigNode& value) {
  static const std::regex capitals("[A-Z]+");
  return value.is_scalar() && std::regex_match(value.text(), capitals);
}

/// Whether a block leaves something out. Comments do not count.
bool is_sketch(const ConfigNode& node) {
  if (node.is_scalar()) return leaves_out(node.text());
  if (std::any_of(node.items().begin(), node.items().end(), is_sketch)) return true;
  for (const auto& [key, where, value] : node.entries()) {
    if (leaves_out(key) || is_sketch(value)) return true;
    if ((key == "learner" || key == "guider") && is_blank_to_fill(value)) return true;
  }
  return false;
}

/// Moves the entries of `part` whose keys are listed into the mapping `key` of it.
template <class Keys>
void gather(ConfigNode& part, std::string_view key, const Keys& keys) {
  ConfigNode inner = ConfigNode::mapping();
  for (const std::string_view each : keys) {
    if (part.find(each) != nullptr) inner.set(std::string(each), part.take(each));
  }
  if (inner.entries().empty()) return;
  const bool there = part.find(key) != nullptr;
  part.set(std::string(key), there ? merged(part.take(key), std::move(inner)) : std::move(inner));
}

/// Gives a guide that states neither a learner nor methods those of the simplest one.
void complete_guiding(ConfigNode& part) {
  ConfigNode* integrator = part.find("integrator");
  ConfigNode* guiding = integrator == nullptr ? nullptr : integrator->find("guiding");
  if (guiding == nullptr || !guiding->is_mapping()) return;
  for (const char* key : {"learner", "guider", "methods"}) {
    if (guiding->find(key) != nullptr) return;
  }
  guiding->set("learner", ConfigNode::scalar("uniform"));
  guiding->set("guider", ConfigNode::scalar("uniform"));
}

/// Returns a scene with the parts that every scene needs and `part` does not state.
ConfigNode scene_with(ConfigNode part) {
  if (part.find("sensor") == nullptr) part.set("sensor", ConfigNode::scalar("perspective"));
  if (part.find("shapes") == nullptr) part.set("shapes", parse_yaml("[sphere]", "a small scene"));
  return part;
}

void check_experiment(const fs::path& file) {
  plan_experiment(load_experiment(file, {}, all_plugins()), all_plugins());
}

std::string problem_of_render(const std::string& yaml, const Workbench& bench) {
  const fs::path file = bench.write("configs/block.yaml", yaml);
  ConfigNode config = read_config(file);
  if (config.find("scene") == nullptr) {
    bench.write("configs/block.yaml", to_yaml(render_with(std::move(config))));
  }
  const testing::Outcome outcome = bench.run("validate configs/block.yaml");
  return outcome.exit_code == 0 ? "" : outcome.err;
}

/// Returns what is wrong with a complete block. Throws when the library does.
std::string problem_of(const ConfigNode& block, const std::string& yaml, const Workbench& bench) {
  if (block.find("methods") != nullptr && block.find("scenes") != nullptr) {
    check_experiment(bench.write("configs/experiments/block.yaml", yaml));
    return {};
  }
  if (block.find("integrands") != nullptr) {
    const fs::path file = bench.write("configs/convergence/block.yaml", yaml);
    laboratory::load_laboratory(file, {}, all_plugins());
    return {};
  }
  return problem_of_render(yaml, bench);
}

}  // namespace

ConfigNode render_with(ConfigNode part) {
  if (has_one_of_scene(part)) {
    gather(part, "scene", std::to_array<std::string_view>({"sensor"}));
    gather(part, "scene", kSceneKeys);
    part.set("scene", scene_with(part.take("scene")));
  }
  gather(part, "guiding", kGuidingKeys);
  gather(part, "integrator", kIntegratorKeys);
  complete_guiding(part);
  const bool has_budget = part.find("budget") != nullptr;
  const std::string base =
      "scene: ../scenes/cornell-box/scene.yaml\nfilm: { width: 8, height: 8 }\n"
      "integrator: { type: path }\n";
  return merged(parse_yaml(base + (has_budget ? "" : "budget: { spp: 64 }\n"), "a small render"),
                std::move(part));
}

BlockCheck check_block(const std::string& yaml, const Workbench& bench) try {
  ConfigNode block;
  try {
    block = parse_yaml(yaml, "block");
  } catch (const InputError&) {
    if (leaves_out(yaml)) return {.depth = Depth::skipped, .problem = {}};
    throw;
  }
  if (is_sketch(block)) return {.depth = Depth::parsed, .problem = {}};
  // A plugin alone does not say where it belongs.
  if (block.find("type") != nullptr) return {.depth = Depth::parsed, .problem = {}};
  if (!block.is_mapping()) return {.depth = Depth::parsed, .problem = "it is no mapping"};
  return {.depth = Depth::validated, .problem = problem_of(block, yaml, bench)};
} catch (const std::exception& e) {
  return {.depth = Depth::validated, .problem = e.what()};
}

void save_named_blocks(const std::vector<Fence>& fences, const Workbench& bench) {
  static const std::regex name("`(configs/[\\w-]+\\.yaml)`");
  for (const Fence& fence : fences) {
    std::smatch parts;
    if (fence.language != "yaml" || !std::regex_search(fence.before, parts, name)) continue;
    if (!bench.has(parts[1])) bench.write(parts[1], fence.text);
  }
}

}  // namespace pharos::docs
