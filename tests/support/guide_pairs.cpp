#include "guide_pairs.h"

#include <pharos/conformance/subjects.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/learner.h>

namespace pharos::testing {
namespace {

using conformance::Subject;

bool suit(const Subject& guider, const Subject& learner) {
  const auto model = static_cast<const Learner&>(*learner.component).empty_model();
  return static_cast<const Guider&>(*guider.component).find(*model) != nullptr;
}

}  // namespace

std::vector<GuidePair> guide_pairs(const Registry& registry) {
  const conformance::ExampleFolder folder;
  const auto subjects_of = [&](std::string_view contract) {
    return conformance::first_cases(registry, contract, folder.path());
  };
  const std::vector<Subject> guiders = subjects_of(Guider::contract_name);
  std::vector<GuidePair> pairs;
  for (const Subject& learner : subjects_of(Learner::contract_name)) {
    for (const Subject& guider : guiders) {
      if (!suit(guider, learner)) continue;
      const std::string &a = learner.plugin->name, &b = guider.plugin->name;
      pairs.push_back(
          {a == b ? a : a + "+" + b, to_flow_yaml(learner.node), to_flow_yaml(guider.node)});
    }
  }
  return pairs;
}

}  // namespace pharos::testing
