#include "guide_pairs.h"

#include <pharos/conformance/subjects.h>
#include <pharos/guiding/guider.h>
#include <pharos/guiding/learner.h>

namespace pharos::bench {
namespace {

using conformance::Subject;

/// The first case of every plugin of a contract.
template <class Contract>
std::vector<Subject> subjects_of(const Registry& registry,
                                 const conformance::ExampleFolder& folder) {
  std::vector<Subject> all;
  for (const std::string& name : registry.names(Contract::contract_name)) {
    const PluginInfo& plugin = *registry.find(Contract::contract_name, name);
    conformance::Cases cases = conformance::cases_of(registry, plugin, folder.path());
    if (!cases.subjects.empty()) all.push_back(std::move(cases.subjects.front()));
  }
  return all;
}

template <class Contract>
std::string model_of(const Subject& subject) {
  return static_cast<const Contract&>(*subject.component).traits().model;
}

}  // namespace

std::vector<GuidePair> guide_pairs(const Registry& registry) {
  const conformance::ExampleFolder folder;
  const std::vector<Subject> guiders = subjects_of<Guider>(registry, folder);
  std::vector<GuidePair> pairs;
  for (const Subject& learner : subjects_of<Learner>(registry, folder)) {
    for (const Subject& guider : guiders) {
      if (model_of<Learner>(learner) != model_of<Guider>(guider)) continue;
      const std::string &a = learner.plugin->name, &b = guider.plugin->name;
      pairs.push_back(
          {a == b ? a : a + "+" + b, to_flow_yaml(learner.node), to_flow_yaml(guider.node)});
    }
  }
  return pairs;
}

}  // namespace pharos::bench
