#include <map>
#include <utility>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/experiments/pictures/learned_file.h>

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
LearnedMixing read_mixing(const LearnedFile& file, const std::filesystem::path& path,
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

}  // namespace

LearnedFile read_learned_file(const std::filesystem::path& path, const Registry& registry) {
  LearnedFile file{.head = read_model_head(path)};
  std::map<std::string, std::size_t> read_before;  // by learner
  for (const ModelHeader& header : file.head.models) {
    const auto learner = plugin<Learner>(path, "learned", header.learner, registry,
                                         ConfigNode::scalar(header.learner));
    file.models.push_back(read_model_file(path, *learner, read_before[header.learner]++));
  }
  file.mixing = read_mixing(file, path, registry);
  return file;
}

}  // namespace pharos
