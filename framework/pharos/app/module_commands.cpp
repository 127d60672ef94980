#include "module_commands.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/command.h>
#include <pharos/core/log.h>
#include <pharos/core/threads.h>

#include "commands.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace pharos {
namespace {

/// The arguments after a command's name.
struct Typed {
  const PluginInfo& plugin;
  std::string config;
  std::vector<std::string> overrides;
  std::vector<std::string> texts;     ///< indexed by parameter
  std::vector<CLI::Option*> options;  ///< indexed by parameter; tell whether each was given
  int threads = 0;
  bool quiet = false;
};

std::string option_name(const ParameterInfo& parameter) {
  std::string name = parameter.key;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string help_of(const ParameterInfo& parameter) {
  std::string text = parameter.help;
  if (!parameter.unit.empty()) text += " [" + parameter.unit + "]";
  if (!parameter.range.empty()) text += ", " + parameter.range;
  if (!parameter.default_value.empty()) text += "; default " + parameter.default_value;
  return text;
}

/// Returns the value of an option. It is YAML, except that texts are taken literally and lists need
/// no brackets.
ConfigNode value_of(const ParameterInfo& parameter, const std::string& text) {
  const Location where{fmt::format("--{} {}", option_name(parameter), one_line(text, 60))};
  if (parameter.type == "boolean") return ConfigNode::scalar("true", where);
  if (parameter.type == "path" || parameter.type == "string") {
    return ConfigNode::scalar(text, where);
  }
  const bool is_bare = parameter.type.starts_with("list of ") && !text.starts_with('[');
  return parse_yaml_at(is_bare ? "[" + text + "]" : text, where);
}

/// Returns the settings of the file, overridden by the options.
ConfigNode settings_of(const Typed& typed) {
  const Location where{"pharos " + typed.plugin.name};
  ConfigNode node = typed.config.empty() ? ConfigNode::mapping(where) : read_config(typed.config);
  for (const std::string& assignment : typed.overrides) apply_override(node, assignment);
  for (std::size_t i = 0; i < typed.options.size(); ++i) {
    if (typed.options[i]->count() == 0) continue;
    const ParameterInfo& parameter = typed.plugin.parameters[i];
    node.set(parameter.key, value_of(parameter, typed.texts[i]));
  }
  node.set("type", ConfigNode::scalar(typed.plugin.name, where));
  return node;
}

int run(const Command& command, bool quiet) {
  const InterruptGuard interrupt;
  ProgressBar bar;
  const auto start = std::chrono::steady_clock::now();
  CommandControl control{.stop = &interrupt.flag()};
  if (!quiet) {
    control.on_progress = [&](double fraction) {
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
      bar.show(fraction, passed.count());
    };
  }
  control.on_message = [&](const std::string& message) {
    bar.clear();
    log_info(message);
  };
  return command.run(control) == CommandEnd::done ? kDone : kInterrupted;
}

int build_and_run(const Typed& typed, const Registry& registry) {
  set_log_quiet(typed.quiet);
  BuildContext context{.registry = registry};
  ConfigNode resolved;
  return run(*registry.build<Command>(settings_of(typed), context, resolved), typed.quiet);
}

void add_options(CLI::App& command, Typed& typed) {
  command.add_option("config", typed.config, "Settings (YAML)");
  command.add_option("--set", typed.overrides, "Override one value, such as --set rule.radius=1")
      ->take_all()
      ->expected(1)
      ->type_name("KEY=VALUE");
  typed.texts.resize(typed.plugin.parameters.size());
  for (std::size_t i = 0; i < typed.texts.size(); ++i) {
    const ParameterInfo& parameter = typed.plugin.parameters[i];
    const std::string name = (parameter.key == "output" ? "-o,--" : "--") + option_name(parameter);
    const std::string help = help_of(parameter);
    typed.options.push_back(
        parameter.type == "boolean"
            ? command.add_flag(name, help)
            : command.add_option(name, typed.texts[i], help)->type_name("VALUE"));
  }
  command.add_option("--threads", typed.threads, "Number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
  command.add_flag("-q,--quiet", typed.quiet, "Only warnings and errors");
}

}  // namespace

bool has_command(const CLI::App& app, const std::string& name) {
  const std::vector<const CLI::App*> all = app.get_subcommands({});
  return std::any_of(all.begin(), all.end(),
                     [&](const CLI::App* command) { return command->get_name() == name; });
}

void add_module_commands(CLI::App& app, const Registry& registry, int& exit_code) {
  for (const std::string& name : registry.names(Command::contract_name)) {
    const PluginInfo& plugin = *registry.find(Command::contract_name, name);
    if (has_command(app, name)) {
      throw InputError(fmt::format("module '{}' brings the command '{}', which the program has",
                                   plugin.module, name));
    }
    CLI::App* command = app.add_subcommand(name, plugin.summary);
    const auto typed = std::make_shared<Typed>(Typed{.plugin = plugin});
    add_options(*command, *typed);
    command->callback([typed, &registry, &exit_code] {
      with_threads(typed->threads, [&] { exit_code = build_and_run(*typed, registry); });
    });
  }
}

}  // namespace pharos
