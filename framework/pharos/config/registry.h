#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/config/node.h>
#include <pharos/config/schema.h>

namespace pharos {

/// The description of one plugin.
struct PluginInfo {
  std::string contract;
  std::string name;
  std::string summary;                    ///< one line of text
  std::string module;                     ///< name of the library that registered it
  std::vector<std::string> papers;        ///< to be cited: "Authors: Title. Venue, year"
  std::vector<ParameterInfo> parameters;  ///< in the order of declaration
  std::vector<std::string> examples;      ///< settings as YAML mappings, see Schema::example
  /// Parses and checks `node`, builds the component, and writes the resolved mapping.
  std::function<std::shared_ptr<Component>(const ConfigNode& node, BuildContext& context,
                                           ConfigNode& resolved)>
      build;
};

/// All plugins by (contract, name). load_modules() fills the registry; it is constant afterwards.
class Registry {
 public:
  /// Registers the class P under its contract. The struct P::Settings declares
  /// `static void describe(Schema<Settings>&)`, and P has a constructor from Settings. `papers` are
  /// those from which the method comes, such as "A. Rath, P. Slusallek: Title. Venue, 2023". Images
  /// and reports name the papers of the plugins that they have used. Throws InputError with the
  /// names of both modules if the name is taken.
  template <class P>
  void add(std::string name, std::string summary, std::vector<std::string> papers = {});

  /// Makes `name` the plugin that is meant by a bare number or list where contract C is expected:
  /// `reflectance: 0.5` is then read as `{ type: name, key: 0.5 }`.
  template <class C>
  void set_shorthand(std::string name, std::string key) {
    shorthands_[std::string(C::contract_name)] = {std::move(name), std::move(key)};
  }

  /// Makes `name` the plugin that is meant by the word `default` where contract C is expected.
  template <class C>
  void set_default(std::string name) {
    defaults_[std::string(C::contract_name)] = std::move(name);
  }

  /// States the name that a plugin of contract C had before. A config that uses it is refused with
  /// a message that gives the new name.
  template <class C>
  void renamed(std::string old_name, std::string new_name) {
    renamed_[std::string(C::contract_name)][std::move(old_name)] = std::move(new_name);
  }

  /// Builds the component of contract C that `node` describes. The node is a mapping with `type`,
  /// the name of a plugin without further settings, `default`, the name of an entry of the scene's
  /// dictionaries, or the shorthand of the contract. An entry of the dictionaries takes precedence
  /// over a plugin of the same name. `resolved` receives the plugin with the values of its
  /// parameters, or the name of the entry. Throws InputError with the location and the nearest
  /// name. Errors of a constructor that have no location get the location of `node`. Never returns
  /// null.
  template <class C>
  Ref<C> build(const ConfigNode& node, BuildContext& context, ConfigNode& resolved) const {
    return std::static_pointer_cast<const C>(
        build_component(std::string(C::contract_name), node, context, resolved));
  }

  /// Returns the names of all contracts that have plugins, or the names of all plugins of a
  /// contract, sorted.
  std::vector<std::string> contracts() const;
  std::vector<std::string> names(std::string_view contract) const;
  /// Returns null if there is no such plugin.
  const PluginInfo* find(std::string_view contract, std::string_view name) const;

  /// Sets the module of the plugins that are registered next. Called by the loader.
  void set_current_module(std::string module) { current_module_ = std::move(module); }
  /// Adds a folder in which plugins were searched. Error messages name these folders.
  void add_searched_folder(std::string folder) { searched_.push_back(std::move(folder)); }
  const std::vector<std::string>& searched_folders() const { return searched_; }

 private:
  struct Shorthand {
    std::string plugin, key;
  };

  void add_info(PluginInfo info);
  std::shared_ptr<const Component> build_component(const std::string& contract,
                                                   const ConfigNode& node, BuildContext& context,
                                                   ConfigNode& resolved) const;
  /// Builds the plugin that `name` names. `settings` is the mapping of its settings, which may hold
  /// `type`.
  std::shared_ptr<const Component> build_plugin(const std::string& contract, const ConfigNode& name,
                                                const ConfigNode& settings, BuildContext& context,
                                                ConfigNode& resolved) const;
  const PluginInfo& require(const std::string& contract, const ConfigNode& name,
                            const BuildContext& context) const;

  std::map<std::string, std::map<std::string, PluginInfo, std::less<>>, std::less<>> plugins_;
  std::map<std::string, Shorthand, std::less<>> shorthands_;
  std::map<std::string, std::string, std::less<>> defaults_;
  std::map<std::string, std::map<std::string, std::string>> renamed_;  ///< by contract, old to new
  std::vector<std::string> searched_;
  std::string current_module_ = "program";
};

template <class P>
void Registry::add(std::string name, std::string summary, std::vector<std::string> papers) {
  using Settings = typename P::Settings;
  Schema<Settings> schema;
  Settings::describe(schema);
  PluginInfo info{.contract = std::string(P::contract_name),
                  .name = std::move(name),
                  .summary = std::move(summary),
                  .module = current_module_,
                  .papers = std::move(papers),
                  .parameters = schema.parameters(),
                  .examples = schema.examples(),
                  .build = {}};
  info.build = [schema = std::move(schema)](const ConfigNode& node, BuildContext& context,
                                            ConfigNode& resolved) {
    return std::make_shared<P>(schema.read(node, context, resolved, "type"));
  };
  add_info(std::move(info));
}

template <class C>
std::shared_ptr<const C> Value<std::shared_ptr<const C>>::read(const ConfigNode& node,
                                                               BuildContext& context,
                                                               ConfigNode& resolved) {
  return context.registry.template build<C>(node, context, resolved);
}

/// The settings of plugins that have no parameters.
struct NoSettings {
  static void describe(Schema<NoSettings>&) {}
};

}  // namespace pharos
