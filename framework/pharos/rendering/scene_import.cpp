#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/packed_name.h>
#include <pharos/rendering/scene_import.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

/// Returns the name of the importer: the extension without the dot and in lower case. The `.gz` of
/// packed files does not count.
std::string importer_name(const fs::path& file) {
  std::string extension = unpacked_name(file).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Returns whether a node states members of the plugin of `imported`, or of any plugin.
bool extends(const ConfigNode& stated, const ConfigNode& imported) {
  const ConfigNode* type = stated.find("type");
  const ConfigNode* imported_type = imported.find("type");
  if (type == nullptr) return stated.is_mapping();
  return imported_type != nullptr && type->text() == imported_type->text();
}

/// Returns a plugin as a mapping, also if only its name is stated.
ConfigNode with_type(ConfigNode plugin) {
  if (!plugin.is_scalar()) return plugin;
  ConfigNode mapping = ConfigNode::mapping();
  mapping.set("type", std::move(plugin));
  return mapping;
}

/// Samples per pixel of a scene that is rendered without a config.
constexpr const char* kSamplesOfBareScenes = "64";

/// Returns whether a file is a scene, which a config would name, and not a config.
bool is_bare_scene(const ConfigNode& node) {
  const auto has = [&](std::string_view key) { return node.find(key) != nullptr; };
  return !has("scene") && !has("budget") && (has("shapes") || has("emitters"));
}

/// Merges a stated sampler into the imported one if it is of the same type.
ConfigNode merged_sampler(ConfigNode imported, const ConfigNode& stated) {
  imported = with_type(std::move(imported));
  return extends(stated, imported) ? merged(std::move(imported), stated) : stated;
}

/// Merges a stated integrator into the imported one. Whatever its type, it estimates the same
/// light: the depth and the termination of paths remain unless they are stated.
ConfigNode merged_integrator(ConfigNode imported, const ConfigNode& stated) {
  imported = with_type(std::move(imported));
  const ConfigNode over = with_type(stated);
  if (over.find("roulette") != nullptr) imported.take("termination");
  if (extends(over, imported)) return merged(std::move(imported), over);
  ConfigNode integral = ConfigNode::mapping(imported.where());
  for (const char* key : {"max_depth", "termination"}) {
    if (ConfigNode member = imported.take(key); !member.is_null()) {
      integral.set(key, std::move(member), imported.where());
    }
  }
  return merged(std::move(integral), over);
}

}  // namespace

bool is_importable(const fs::path& file, const Registry& registry) {
  return registry.find(SceneImporter::contract_name, importer_name(file)) != nullptr;
}

Import import_scene(const fs::path& file, const Registry& registry) {
  if (!is_importable(file, registry)) {
    throw InputError(
        fmt::format("{}: error: no importer reads such files: expected a name that ends "
                    "in one of {}",
                    file.string(), quoted_list(registry.names(SceneImporter::contract_name))));
  }
  BuildContext context{registry};
  ConfigNode resolved;
  const ConfigNode name = ConfigNode::scalar(importer_name(file));
  return registry.build<SceneImporter>(name, context, resolved)->import(file);
}

ConfigNode read_config_or_scene(const fs::path& file, const Registry& registry,
                                std::vector<fs::path>* files) {
  ConfigNode config = ConfigNode::mapping({file.string()});
  config.set("scene", ConfigNode::scalar(file.string()));
  if (is_importable(file, registry)) return config;
  ConfigNode stated = read_config(file, files);
  if (!is_bare_scene(stated)) return stated;
  config.set("budget", ConfigNode::mapping());
  config.find("budget")->set("spp", ConfigNode::scalar(kSamplesOfBareScenes));
  return config;
}

std::vector<ImportNote> expand_import(ConfigNode& config, const Registry& registry) {
  const ConfigNode* scene = config.find("scene");
  if (scene == nullptr || !scene->is_scalar() || !is_importable(scene->text(), registry)) return {};
  BuildContext context{registry};
  ConfigNode resolved;
  const fs::path file = Value<fs::path>::read(*scene, context, resolved);
  if (const std::string problem = file_problem(file); !problem.empty()) {
    scene->fail(fmt::format("'{}': {}", scene->text(), problem));
  }
  Import import = import_scene(file, registry);
  config.set("scene", import.config.take("scene"), config.where_key("scene"));
  for (const char* key : {"sampler", "integrator", "budget"}) {
    ConfigNode imported = import.config.take(key);
    if (imported.is_null()) continue;
    const ConfigNode* stated = config.find(key);
    if (stated == nullptr) {
      config.set(key, std::move(imported));
    } else if (key == "sampler"sv) {
      config.set(key, merged_sampler(std::move(imported), *stated));
    } else if (key == "integrator"sv) {
      config.set(key, merged_integrator(std::move(imported), *stated));
    }
  }
  if (ConfigNode film = import.config.take("film"); film.is_mapping()) {
    const ConfigNode* stated = config.find("film");
    config.set("film", stated == nullptr ? std::move(film) : merged(std::move(film), *stated));
  }
  return std::move(import.notes);
}

}  // namespace pharos
