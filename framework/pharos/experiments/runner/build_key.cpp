#include <filesystem>
#include <link.h>
#include <map>
#include <set>

#include <pharos/core/error.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/content_key.h>

namespace pharos {
namespace {

/// Returns the files of all libraries of the process, by name without folder and extensions.
std::map<std::string, std::string> loaded_libraries() {
  std::map<std::string, std::string> files;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* found) {
        const std::filesystem::path path = info->dlpi_name;
        const std::string name = path.filename().string();
        static_cast<std::map<std::string, std::string>*>(found)->emplace(
            name.substr(0, name.find('.')), path.string());
        return 0;
      },
      &files);
  return files;
}

void collect_scalars(const ConfigNode& node, std::set<std::string>& texts) {
  if (node.is_scalar()) texts.insert(node.text());
  for (const ConfigNode& item : node.items()) collect_scalars(item, texts);
  for (const ConfigNode::Entry& entry : node.entries()) collect_scalars(entry.value, texts);
}

/// Returns the modules that have a plugin with one of these names.
std::set<std::string> modules_of(const std::set<std::string>& names, const Registry& registry) {
  std::set<std::string> modules;
  for (const std::string& contract : registry.contracts()) {
    for (const std::string& name : registry.names(contract)) {
      if (names.contains(name)) modules.insert(registry.find(contract, name)->module);
    }
  }
  return modules;
}

}  // namespace

std::string build_key(const ConfigNode& resolved, const Registry& registry) {
  std::set<std::string> names;
  collect_scalars(resolved, names);
  std::set<std::string> libraries = modules_of(names, registry);
  libraries.insert("libpharos");
  const std::map<std::string, std::string> files = loaded_libraries();
  std::string keys;
  for (const std::string& library : libraries) {
    const auto file = files.find(library);
    keys += library + (file == files.end() ? "" : content_key_of_file(file->second));
  }
  return content_key(keys);
}

void check_build(const ConfigNode& resolved, const std::string& expected,
                 const Registry& registry) {
  if (build_key(resolved, registry) == expected) return;
  throw RunError("Pharos was built anew while the experiment ran: start the experiment again");
}

}  // namespace pharos
