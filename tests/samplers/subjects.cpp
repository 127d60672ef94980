#include "subjects.h"

#include <pharos/config/module_loader.h>
#include <pharos/conformance/subjects.h>
#include <pharos/sampling/sampler.h>

namespace pharos::testing {

std::vector<SamplerSubject> sampler_subjects() {
  Registry registry;
  load_modules(registry, PHAROS_PLUGINS, true);
  const conformance::ExampleFolder folder;
  std::vector<SamplerSubject> all;
  for (const auto& s : conformance::first_cases(registry, Sampler::contract_name, folder.path())) {
    all.push_back({s.plugin->name, to_flow_yaml(s.node)});
  }
  return all;
}

}  // namespace pharos::testing
