#include "previews.h"

#include <fmt/format.h>

#include <pharos/conformance/subjects.h>
#include <pharos/core/log.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/render_job.h>
#include <pharos/scene/emitter.h>

#include "sampler_pictures.h"

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// Returns the settings with which a plugin is shown: those in `chosen`, else its first example,
/// else its defaults. Paths are relative to `files`.
ConfigNode plugin_node(const PluginInfo& plugin, const ConfigNode& chosen, const fs::path& files) {
  const Location where{(files / "example.yaml").string(), 1, 1};
  ConfigNode settings = ConfigNode::mapping(where);
  const ConfigNode* contract = chosen.find(plugin.contract);
  const ConfigNode* given = contract == nullptr ? nullptr : contract->find(plugin.name);
  if (given != nullptr) {
    settings = parse_yaml_at(to_flow_yaml(*given), where);
  } else if (!plugin.examples.empty()) {
    settings = parse_yaml_at(plugin.examples.front(), where);
  }
  settings.set("type", ConfigNode::scalar(plugin.name, where));
  return settings;
}

/// Replaces every mapping with the key `preview` by `plugin`.
void substitute(ConfigNode& node, const ConfigNode& plugin) {
  for (ConfigNode& item : node.items()) substitute(item, plugin);
  for (ConfigNode::Entry& entry : node.entries()) substitute(entry.value, plugin);
  if (node.find("preview") == nullptr) return;
  node.take("preview");
  for (const ConfigNode::Entry& entry : plugin.entries()) node.set(entry.key, entry.value);
}

bool needs_shape(const ConfigNode& emitter, const Registry& registry) {
  BuildContext context{.registry = registry};
  ConfigNode resolved;
  return registry.build<Emitter>(emitter, context, resolved)->needs_shape();
}

void render_preview(const PluginInfo& plugin, const ConfigNode& node, const Registry& registry,
                    const fs::path& folder) {
  const bool on_shape = plugin.contract == Emitter::contract_name && needs_shape(node, registry);
  ConfigNode config =
      read_config(folder / (plugin.contract + (on_shape ? "-on-shape" : "") + ".yaml"));
  substitute(config, node);
  const LoadedConfig loaded = build_render_config(config, registry);
  const RenderResult result = RenderJob(loaded.config).run();
  write_png(result.image, folder / preview_name(plugin), loaded.config.output.exposure,
            loaded.config.output.filmic);
}

/// Draws the points of each sampler beside their spectrum.
void draw_samplers(const Registry& registry, const fs::path& folder) {
  for (const NamedSampler& s : pictured_samplers(registry)) {
    log_info(fmt::format("preview of the sampler '{}'", s.name));
    const PluginInfo& plugin = *registry.find(Sampler::contract_name, s.name);
    write_png(sampler_pictures(std::span(&s, 1)), folder / preview_name(plugin), 0, false);
  }
}

}  // namespace

std::string preview_name(const PluginInfo& plugin) {
  return plugin.contract + "-" + plugin.name + ".png";
}

void render_previews(const Registry& registry, const fs::path& folder) {
  const conformance::ExampleFolder files;
  const ConfigNode chosen = read_config(folder / "settings.yaml");
  for (const std::string contract : {"bsdf", "emitter", "shape"}) {
    for (const std::string& name : registry.names(contract)) {
      log_info(fmt::format("preview of the {} '{}'", contract, name));
      const PluginInfo& plugin = *registry.find(contract, name);
      render_preview(plugin, plugin_node(plugin, chosen, files.path()), registry, folder);
    }
  }
  draw_samplers(registry, folder);
}

}  // namespace pharos
