#include "inspected_file.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

/// Builds the plugin of contract C with the name `name`, by which the file was `what`.
template <class C>
Ref<C> plugin(const std::filesystem::path& path, const char* what, const std::string& name,
              const Registry& registry, const ConfigNode& config) {
  if (registry.find(C::contract_name, name) == nullptr) {
    throw InputError(
        fmt::format("the model file '{}' was {} by '{}', which no module here has: there are {}",
                    path.string(), what, name, quoted_list(registry.names(C::contract_name))));
  }
  BuildContext context{registry};
  ConfigNode resolved;
  return registry.build<C>(config, context, resolved);
}

/// Reads what the mixing policy has learned about the models that were read before.
LearnedMixing read_mixing(const InspectedFile& file, const std::filesystem::path& path,
                          const Registry& registry) {
  LearnedMixing mixing;
  std::vector<std::uint32_t> first_regions;
  std::uint32_t regions = 0;
  for (const auto& model : file.models) {
    first_regions.push_back(regions);
    regions += model->info().regions;
  }
  std::vector<float> weights;
  for (const LearnedMethod& method : file.head.methods) {
    weights.push_back(method.weight);
    mixing.methods.push_back({file.models[method.model], first_regions[method.model]});
  }
  const auto policy = plugin<MixingPolicy>(path, "mixed", file.head.mixing, registry,
                                           parse_yaml(file.head.mixing_config, path.string()));
  const auto state = policy->begin(weights);
  state->update(regions, {}, false);
  load_mixing_state(path, read_mixing_state(path), *state);
  mixing.shares = state->shares();
  return mixing;
}

InspectedFile read(const std::filesystem::path& path, const Registry& registry) {
  InspectedFile file{.head = read_model_head(path)};
  std::map<std::string, std::size_t> read_before;  // by learner
  for (const ModelHeader& header : file.head.models) {
    const auto learner = plugin<Learner>(path, "learned", header.learner, registry,
                                         ConfigNode::scalar(header.learner));
    file.models.push_back(read_model_file(path, *learner, read_before[header.learner]++));
  }
  file.mixing = read_mixing(file, path, registry);
  return file;
}

std::vector<ModelFact> facts_of(const ModelHeader& header, const GuidingModel& model) {
  ModelInfo info = model.info();
  const Bounds3& bounds = info.bounds;
  std::vector<ModelFact> facts = {
      {"model", fmt::format("{}, version {}", header.model, header.version)},
      {"learner", header.learner},
      {"saved", fmt::format("{} bytes", header.bytes)},
      {"memory", fmt::format("{} bytes", info.bytes)},
      {"bounds", bounds.empty()
                     ? "none"
                     : fmt::format("{} to {}", point_text(bounds.low), point_text(bounds.high))},
      {"regions", std::to_string(info.regions)}};
  for (ModelFact& fact : info.facts) facts.push_back(std::move(fact));
  return facts;
}

/// Returns the mean shares at vertices of different kinds, wherever in `bounds` a model knows
/// something.
std::vector<ModelFact> facts_of_mixing(const InspectedFile& file, const Bounds3& bounds) {
  std::vector<ModelFact> facts = {{"mixing", file.head.mixing}};
  for (const std::uint16_t bounce : {1, 2}) {
    for (const float roughness : kShownRoughness) {
      if (bounds.empty()) return facts;
      const std::vector<float> shares = mean_shares(file.mixing, bounds, {roughness, bounce});
      if (shares.empty()) return facts;
      std::string text = fmt::format("unguided {:.3f}", shares[0]);
      for (std::size_t i = 0; i < file.head.methods.size(); ++i) {
        text += fmt::format(", {} {:.3f}", file.head.models[file.head.methods[i].model].learner,
                            shares[1 + i]);
      }
      facts.push_back({fmt::format("bounce {}, roughness {:g}", bounce, roughness), text});
    }
  }
  return facts;
}

void print_aligned(const std::vector<ModelFact>& facts) {
  std::size_t width = 0;
  for (const ModelFact& fact : facts) width = std::max(width, fact.name.size());
  for (const ModelFact& fact : facts) fmt::print("{:<{}}  {}\n", fact.name, width, fact.value);
}

}  // namespace

std::string point_text(Point3 p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

InspectedFile read_inspected(const std::filesystem::path& path, const Registry& registry) {
  try {
    return read(path, registry);
  } catch (const InputError& error) {
    throw InputError(fmt::format("pharos inspect: error: {}", error.what()));
  }
}

void print_facts(const InspectedFile& file, Bounds3 bounds) {
  for (std::size_t i = 0; i < file.models.size(); ++i) {
    print_aligned(facts_of(file.head.models[i], *file.models[i]));
    const Bounds3 own = file.models[i]->info().bounds;
    if (own.empty()) continue;
    bounds.add(own.low);
    bounds.add(own.high);
  }
  print_aligned(facts_of_mixing(file, bounds));
}

}  // namespace pharos
