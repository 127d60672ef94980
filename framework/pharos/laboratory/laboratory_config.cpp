#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include <pharos/experiments/runner/entry_names.h>
#include <pharos/laboratory/laboratory_config.h>

namespace pharos::laboratory {
namespace {

/// The smallest number of values that determine a straight line and its scatter.
constexpr std::uint32_t kLeastFitted = 3;

/// The largest exponent. With more points, samplers with finite sets would begin a second set,
/// which does not represent the behavior of a single set.
constexpr std::uint32_t kMostPower = 16;

/// Returns whether a sampler can be built from its name alone and works without a scene.
bool stands_alone(const Registry& registry, const std::string& name) {
  for (const ParameterInfo& parameter : registry.find("sampler", name)->parameters) {
    if (parameter.required) return false;
  }
  BuildContext context{registry};
  ConfigNode resolved;
  return !registry.build<Sampler>(ConfigNode::scalar(name), context, resolved)->needs_probe();
}

/// Inserts the registered samplers if the config has no list of samplers. Returns the samplers that
/// were left out.
std::vector<std::string> add_samplers(ConfigNode& root, const Registry& registry) {
  std::vector<std::string> left_out;
  if (root.find("samplers") != nullptr) return left_out;
  ConfigNode list = ConfigNode::sequence(root.where());
  for (const std::string& name : registry.names("sampler")) {
    if (!stands_alone(registry, name)) {
      left_out.push_back(name);
      continue;
    }
    ConfigNode entry = ConfigNode::mapping(root.where());
    entry.set("name", ConfigNode::scalar(name, root.where()));
    entry.set("sampler", ConfigNode::scalar(name, root.where()));
    list.items().push_back(std::move(entry));
  }
  root.set("samplers", std::move(list));
  return left_out;
}

void check_range(const PowerRange& range, const ConfigNode* node) {
  if (range.to >= range.from + kLeastFitted - 1) return;
  node->fail(fmt::format("expected 'to' to be at least {} above 'from', found {} and {}",
                         kLeastFitted - 1, range.from, range.to));
}

void check_ranges(const LaboratoryConfig& config, const ConfigNode& root) {
  if (const ConfigNode* samples = root.find("samples")) check_range(config.samples, samples);
  if (!config.fit) return;
  const ConfigNode* fit = root.find("fit");
  check_range(*config.fit, fit);
  if (config.fit->from < config.samples.from || config.fit->to > config.samples.to) {
    fit->fail(fmt::format("expected a range within that of 'samples', {} to {}, found {} to {}",
                          config.samples.from, config.samples.to, config.fit->from,
                          config.fit->to));
  }
}

void check_samplers(const LaboratoryConfig& config, const ConfigNode& root) {
  for (std::size_t i = 0; i < config.samplers.size(); ++i) {
    if (!config.samplers[i].sampler->needs_probe()) continue;
    root.find("samplers")
        ->items()[i]
        .fail(fmt::format("the sampler '{}' adapts to a scene, and there is none here",
                          config.samplers[i].sampler->plugin_name()));
  }
}

std::string default_baseline(const std::vector<NamedSampler>& samplers) {
  const auto found = std::find_if(samplers.begin(), samplers.end(), [](const NamedSampler& s) {
    return s.sampler->plugin_name() == "independent";
  });
  return found == samplers.end() ? "" : found->name;
}

}  // namespace

void PowerRange::describe(Schema<PowerRange>& s) {
  const auto is_held = [](std::uint32_t power) { return power <= kMostPower; };
  const std::string rule =
      fmt::format("an exponent of at most {}, as many samplers' sets hold no more than 2^{} points",
                  kMostPower, kMostPower);
  s.field("from", &PowerRange::from, "Exponent of the smallest number of points")
      .check(rule, is_held);
  s.field("to", &PowerRange::to, "Exponent of the largest number of points").check(rule, is_held);
}

void NamedIntegrand::describe(Schema<NamedIntegrand>& s) {
  s.field("name", &NamedIntegrand::name, "Name in tables")
      .required()
      .check(kEntryNameRule, is_entry_name);
  s.field("integrand", &NamedIntegrand::integrand, "Function to integrate").required();
}

void SpectrumSettings::describe(Schema<SpectrumSettings>& s) {
  s.field("points", &SpectrumSettings::points, "Number of points of each set; 0: no pictures")
      .at_most(65536)
      .check("0 or a power of two",
             [](std::uint32_t n) { return n == 0 || std::has_single_bit(n); });
  s.field("realizations", &SpectrumSettings::realizations,
          "Number of sets over which a picture is averaged")
      .at_least(1)
      .at_most(10000);
  s.field("max_frequency", &SpectrumSettings::max_frequency, "Largest frequency along each axis")
      .unit("cycles per side of the square")
      .at_least(1)
      .at_most(512);
}

void LaboratoryConfig::describe(Schema<LaboratoryConfig>& s) {
  s.field("title", &LaboratoryConfig::title, "Heading of the report");
  s.field("description", &LaboratoryConfig::description,
          "Question of the measurement, in a sentence or two");
  s.field("integrands", &LaboratoryConfig::integrands, "Functions to integrate").required();
  s.field("samplers", &LaboratoryConfig::samplers,
          "Samplers to compare; by default all registered samplers");
  s.field("baseline", &LaboratoryConfig::baseline,
          "Sampler in the denominator of ratios; by default the first of type 'independent'");
  s.field("samples", &LaboratoryConfig::samples, "Numbers of points, powers of two");
  s.field("fit", &LaboratoryConfig::fit,
          "Numbers of points that slopes are fitted to; by default all");
  s.field("realizations", &LaboratoryConfig::realizations,
          "Number of point sets for each number of points")
      .at_least(16)
      .at_most(1000000);
  s.field("preparations", &LaboratoryConfig::preparations,
          "Number of groups of realizations, each with tables of its own; intervals are estimated "
          "from groups")
      .at_least(8)
      .at_most(1000000);
  s.field("seed", &LaboratoryConfig::seed, "Seed of all random numbers").at_least(0);
  s.field("spectrum", &LaboratoryConfig::spectrum, "Settings of the pictures of power spectra");
  s.field("output", &LaboratoryConfig::output,
          "Folder, relative to the current one; by default the file's name");
}

LaboratoryConfig load_laboratory(const std::filesystem::path& path,
                                 const std::vector<std::string>& overrides,
                                 const Registry& registry) {
  ConfigNode root = read_config(path);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  std::vector<std::string> left_out = add_samplers(root, registry);
  BuildContext context{registry};
  ConfigNode resolved;
  auto config = Value<LaboratoryConfig>::read(root, context, resolved);
  names_of(config.integrands, root, "integrands");
  const std::vector<std::string> samplers = names_of(config.samplers, root, "samplers");
  if (!config.baseline.empty()) check_baseline(config.baseline, samplers, "sampler", root);
  check_ranges(config, root);
  check_samplers(config, root);
  const std::string name = path.stem().string();
  config.source = std::filesystem::absolute(path).lexically_normal();
  config.resolved = to_yaml(resolved);
  config.left_out = std::move(left_out);
  if (config.title.empty()) config.title = name;
  if (config.baseline.empty()) config.baseline = default_baseline(config.samplers);
  if (config.output.empty()) config.output = name;
  return config;
}

}  // namespace pharos::laboratory
