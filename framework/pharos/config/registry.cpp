#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <pharos/config/registry.h>

namespace pharos {
namespace {

std::vector<std::string> named_components(const BuildContext& context,
                                          const std::string& contract) {
  std::vector<std::string> names;
  for (const BuildContext::Named& named : context.named) {
    if (named.contract == contract) names.push_back(named.name);
  }
  return names;
}

/// Appends the papers of a plugin that are not there yet.
void add_papers(const PluginInfo& plugin, std::vector<std::string>& papers) {
  for (const std::string& paper : plugin.papers) {
    if (std::find(papers.begin(), papers.end(), paper) == papers.end()) papers.push_back(paper);
  }
}

}  // namespace

std::vector<std::string> Registry::contracts() const {
  std::vector<std::string> all;
  for (const auto& [contract, plugins] : plugins_) all.push_back(contract);
  return all;
}

std::vector<std::string> Registry::names(std::string_view contract) const {
  std::vector<std::string> all;
  const auto found = plugins_.find(contract);
  if (found == plugins_.end()) return all;
  for (const auto& [name, info] : found->second) all.push_back(name);
  return all;
}

const PluginInfo* Registry::find(std::string_view contract, std::string_view name) const {
  const auto plugins = plugins_.find(contract);
  if (plugins == plugins_.end()) return nullptr;
  const auto found = plugins->second.find(name);
  return found == plugins->second.end() ? nullptr : &found->second;
}

void Registry::add_info(PluginInfo info) {
  if (const PluginInfo* taken = find(info.contract, info.name)) {
    throw InputError(fmt::format("module '{}' brings the {} '{}', which module '{}' already has",
                                 info.module, info.contract, info.name, taken->module));
  }
  auto& plugins = plugins_[info.contract];
  std::string name = info.name;
  plugins.emplace(std::move(name), std::move(info));
}

const PluginInfo& Registry::require(const std::string& contract, const ConfigNode& name,
                                    const BuildContext& context) const {
  const std::vector<std::string> plugins = names(contract);
  if (!name.is_scalar()) fail_type(name, fmt::format("the name of a {}", contract));
  if (const PluginInfo* info = find(contract, name.text())) return *info;
  if (const auto names = renamed_.find(contract); names != renamed_.end()) {
    if (const auto now = names->second.find(name.text()); now != names->second.end()) {
      name.fail(fmt::format("the {} '{}' is called '{}' now", contract, now->first, now->second));
    }
  }
  const std::vector<std::string> entries = named_components(context, contract);
  std::vector<std::string> all = plugins;
  all.insert(all.end(), entries.begin(), entries.end());
  std::string message =
      fmt::format("unknown {} '{}'{}; known: {}", contract, one_line(name.text(), 60),
                  suggestion(name.text(), all), quoted_list(plugins));
  constexpr std::size_t kMostListed = 20;
  if (!entries.empty()) {
    const std::span<const std::string> listed(entries.data(),
                                              std::min(entries.size(), kMostListed));
    message += "; named in the scene: " + quoted_list(listed);
    if (entries.size() > kMostListed) message += ", …";
  }
  if (!searched_.empty()) message += "; folders searched: " + quoted_list(searched_);
  name.fail(message);
}

std::shared_ptr<const Component> Registry::build_plugin(const std::string& contract,
                                                        const ConfigNode& name,
                                                        const ConfigNode& settings,
                                                        BuildContext& context,
                                                        ConfigNode& resolved) const {
  const PluginInfo& info = require(contract, name, context);
  resolved = ConfigNode::mapping();
  resolved.set("type", ConfigNode::scalar(info.name));
  try {
    const std::shared_ptr<Component> built = info.build(settings, context, resolved);
    built->plugin_name_ = info.name;
    add_papers(info, context.papers);
    return built;
  } catch (const InputError& e) {
    if (e.located()) throw;
    settings.fail(e.what());
  }
}

std::shared_ptr<const Component> Registry::build_component(const std::string& contract,
                                                           const ConfigNode& node,
                                                           BuildContext& context,
                                                           ConfigNode& resolved) const {
  if (node.is_mapping()) {
    if (const ConfigNode* type = node.find("type")) {
      return build_plugin(contract, *type, node, context, resolved);
    }
    node.fail(fmt::format("the key 'type' of this {} is missing; known types: {}", contract,
                          quoted_list(names(contract))));
  }
  for (const BuildContext::Named& named : context.named) {
    if (!node.is_scalar() || named.contract != contract || named.name != node.text()) continue;
    if (named.error) throw InputError(*named.error);
    resolved = ConfigNode::scalar(named.name);
    return named.component;
  }
  const bool is_value = node.is_sequence() || (node.is_scalar() && is_number(node.text()));
  const auto shorthand = shorthands_.find(contract);
  if (is_value && shorthand != shorthands_.end()) {
    ConfigNode settings = ConfigNode::mapping(node.where());
    settings.set(shorthand->second.key, node, node.where());
    const auto name = ConfigNode::scalar(shorthand->second.plugin, node.where());
    return build_plugin(contract, name, settings, context, resolved);
  }
  if (is_value || node.is_null()) {
    fail_type(node, fmt::format("a {}: its name or a mapping with 'type', one of {}", contract,
                                quoted_list(names(contract))));
  }
  const auto chosen = defaults_.find(contract);
  const bool wants_default = node.text() == "default" && chosen != defaults_.end();
  const auto name = ConfigNode::scalar(wants_default ? chosen->second : node.text(), node.where());
  return build_plugin(contract, name, ConfigNode::mapping(node.where()), context, resolved);
}

}  // namespace pharos
