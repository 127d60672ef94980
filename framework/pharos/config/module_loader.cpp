#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <exception>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <pharos/config/module.h>
#include <pharos/config/module_loader.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".pharos.so";

std::string dl_reason() {
  const char* text = dlerror();
  return one_line(text == nullptr ? "unknown reason" : text);
}

/// Returns the function `name` of an opened library. Throws InputError at `where` if there is none.
template <class Function>
Function* entry_point(void* library, const char* name, const Location& where) {
  void* symbol = dlsym(library, name);
  if (symbol == nullptr) {
    throw InputError(where, fmt::format("not a Pharos module: it has no '{}'", name));
  }
  return reinterpret_cast<Function*>(symbol);
}

/// Attributes registrations to the module `name` as long as the object lives.
class CurrentModule {
 public:
  CurrentModule(Registry& registry, std::string name) : registry_(registry) {
    registry_.set_current_module(std::move(name));
  }
  ~CurrentModule() { registry_.set_current_module("program"); }
  CurrentModule(const CurrentModule&) = delete;
  CurrentModule& operator=(const CurrentModule&) = delete;

 private:
  Registry& registry_;
};

void load_module(Registry& registry, const fs::path& path) {
  const Location where{path.string()};
  const std::string problem = file_problem(path);
  if (!problem.empty()) throw InputError(where, problem);
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw InputError(where, "the module cannot be loaded: " + dl_reason());
  auto* const version = entry_point<int()>(library, "pharos_module_abi_version", where);
  if (const int found = version(); found != kAbiVersion) {
    throw InputError(where, fmt::format("the module was built for ABI version {}, this program "
                                        "has {}; build it again",
                                        found, kAbiVersion));
  }
  auto* const add_plugins = entry_point<void(Registry&)>(library, "pharos_module_register", where);
  const std::string file = path.filename().string();
  const CurrentModule current(registry, file.substr(0, file.size() - kSuffix.size()));
  try {
    add_plugins(registry);
  } catch (const std::exception& e) {
    throw InputError(where, one_line(e.what()));
  }
}

bool is_module(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.size() > kSuffix.size() &&
         std::string_view(name).substr(name.size() - kSuffix.size()) == kSuffix;
}

/// Returns the plugin folders of this library, for the build tree and for an install prefix.
std::vector<fs::path> library_folders() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&default_module_folders), &info) == 0) return {};
  std::error_code failed;
  const fs::path library = fs::canonical(info.dli_fname, failed);
  if (failed) return {};
  const fs::path folder = library.parent_path();
  return {folder.parent_path() / "plugins", folder / "pharos" / "plugins"};
}

/// Returns the entries of PHAROS_MODULE_PATH that are not empty.
std::vector<fs::path> asked_folders() {
  const char* variable = std::getenv("PHAROS_MODULE_PATH");
  const std::string_view all = variable == nullptr ? "" : variable;
  std::vector<fs::path> folders;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end + 1) {
    end = std::min(all.find(':', begin), all.size());
    if (end > begin) folders.emplace_back(all.substr(begin, end - begin));
  }
  return folders;
}

bool contains(const std::vector<fs::path>& folders, const fs::path& folder) {
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& other) {
    std::error_code failed;
    return other == folder || fs::equivalent(other, folder, failed);
  });
}

}  // namespace

void load_modules(Registry& registry, const fs::path& folder, bool required) {
  registry.add_searched_folder(folder.string());
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) {
    const bool exists = fs::exists(folder, failed);
    if (!exists && !required) return;
    throw InputError(Location{folder.string()}, exists
                                                    ? "expected a folder of modules, found a file"
                                                    : "the module folder does not exist");
  }
  std::vector<fs::path> modules;
  for (fs::directory_iterator i(folder, failed), end; !failed && i != end; i.increment(failed)) {
    if (is_module(i->path())) modules.push_back(i->path());
  }
  if (failed) {
    throw InputError(Location{folder.string()},
                     "the module folder cannot be read: " + failed.message());
  }
  std::sort(modules.begin(), modules.end());
  for (const fs::path& module : modules) load_module(registry, fs::absolute(module));
}

std::vector<fs::path> default_module_folders() {
  std::vector<fs::path> folders = library_folders();
  for (const fs::path& folder : asked_folders()) {
    if (!contains(folders, folder)) folders.push_back(folder);
  }
  return folders;
}

Registry load_default_modules() {
  Registry registry;
  const std::vector<fs::path> asked = asked_folders();
  for (const fs::path& folder : default_module_folders()) {
    load_modules(registry, folder, contains(asked, folder));
  }
  return registry;
}

}  // namespace pharos
