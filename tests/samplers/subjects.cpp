#include "subjects.h"

#include <filesystem>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/subjects.h>
#include <pharos/sampling/sampler.h>

namespace pharos::testing {

namespace {

const conformance::ExampleFolder& folder() {
  static const conformance::ExampleFolder folder;
  return folder;
}

const std::vector<conformance::Subject>& first_cases() {
  static const Registry& registry = *[] {
    auto* loaded = new Registry;  // lives as long as its components
    load_modules(*loaded, PHAROS_PLUGINS, true);
    return loaded;
  }();
  static const std::vector<conformance::Subject> cases =
      conformance::first_cases(registry, Sampler::contract_name, folder().path());
  return cases;
}

/// Returns settings with the absolute paths of the files of folder().
std::string with_paths(std::string settings) {
  for (const auto& entry : std::filesystem::directory_iterator(folder().path())) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = settings.find(name);
    if (at != std::string::npos) settings.replace(at, name.size(), entry.path().string());
  }
  return settings;
}

}  // namespace

std::vector<PreparedSubject> prepared_samplers(int pixels) {
  std::vector<PreparedSubject> all;
  for (const conformance::Subject& s : first_cases()) {
    const auto& sampler = static_cast<const Sampler&>(*s.component);
    if (sampler.needs_probe()) continue;
    all.push_back(
        {s.plugin->name, sampler.prepare({.width = pixels, .height = pixels}, {}, nullptr)});
  }
  return all;
}

std::vector<SamplerSubject> sampler_subjects() {
  std::vector<SamplerSubject> all;
  for (const conformance::Subject& s : first_cases()) {
    all.push_back({s.plugin->name, with_paths(to_flow_yaml(s.node))});
  }
  return all;
}

}  // namespace pharos::testing
