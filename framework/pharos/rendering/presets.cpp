#include <vector>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/rendering/presets.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// Returns the type that a component's node states; empty if it states none.
std::string type_of(const ConfigNode* node) {
  if (node == nullptr) return "";
  if (node->is_scalar()) return node->text();
  const ConfigNode* type = node->find("type");
  return type == nullptr || !type->is_scalar() ? "" : type->text();
}

}  // namespace

std::map<std::string, fs::path> find_presets(const Registry& registry) {
  std::map<std::string, fs::path> presets;
  for (const std::string& folder : registry.searched_folders()) {
    std::error_code failed;
    for (fs::directory_iterator i(fs::path(folder) / "presets", failed), end; !failed && i != end;
         i.increment(failed)) {
      if (i->path().extension() == ".yaml") presets[i->path().stem().string()] = i->path();
    }
  }
  return presets;
}

void expand_preset(ConfigNode& config, const Registry& registry) {
  ConfigNode* integrator = config.find("integrator");
  const ConfigNode* guiding = integrator == nullptr ? nullptr : integrator->find("guiding");
  if (guiding == nullptr || !guiding->is_scalar()) return;
  const auto presets = find_presets(registry);
  const auto found = presets.find(guiding->text());
  if (found == presets.end()) {
    std::vector<std::string> names;
    for (const auto& [name, file] : presets) names.push_back(name);
    guiding->fail(fmt::format("there is no preset '{}'{}: expected {}, or a mapping",
                              guiding->text(), suggestion(guiding->text(), names),
                              names.empty() ? "the name of a preset, of which none is installed"
                                            : "one of " + quoted_list(names)));
  }
  ConfigNode preset = read_config(found->second);
  const std::string own = type_of(integrator), other = type_of(preset.find("integrator"));
  if (!own.empty() && !other.empty() && own != other) {
    guiding->fail(fmt::format("the preset '{}' needs the integrator '{}', found '{}'",
                              guiding->text(), other, own));
  }
  integrator->take("guiding");
  config = merged(std::move(preset), std::move(config));
}

}  // namespace pharos
