#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/config/registry.h>

namespace pharos::conformance {

/// A folder with the files that examples may name: `example.exr`, `example.png`, `example.ply` and
/// `example.txt` (eight points). The folder exists as long as the object.
class ExampleFolder {
 public:
  ExampleFolder();
  ~ExampleFolder();
  ExampleFolder(const ExampleFolder&) = delete;
  ExampleFolder& operator=(const ExampleFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// One case of a plugin, built and ready to be tested.
struct Subject {
  const PluginInfo* plugin = nullptr;
  std::string settings;  ///< YAML mapping on one line, without `type`
  ConfigNode node;       ///< the settings with `type`
  std::shared_ptr<const Component> component;
};

/// All cases of a plugin.
struct Cases {
  std::vector<Subject> subjects;
  std::vector<std::string> broken;  ///< examples that cannot be built, with the reason
  /// Defaults that cannot be built, and choices and switches that cannot be built on top of the
  /// first case, with the reason. This is no fault as long as there is a case.
  std::vector<std::string> left_out;
};

/// Builds a plugin from its defaults, from every example, and from the first of these cases with
/// each other value of every choice or switch. Relative paths refer to `folder`.
Cases cases_of(const Registry& registry, const PluginInfo& plugin,
               const std::filesystem::path& folder);

/// Returns the first case of every plugin of a contract, sorted by name: with its defaults or, if
/// these cannot be built, with its first example. Plugins without a case are left out.
std::vector<Subject> first_cases(const Registry& registry, std::string_view contract,
                                 const std::filesystem::path& folder);

}  // namespace pharos::conformance
