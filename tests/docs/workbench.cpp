#include "workbench.h"

#include <pharos/config/module_loader.h>
#include <pharos/laboratory/integrands/add_integrands.h>

namespace pharos::docs {

namespace fs = std::filesystem;

fs::path source_tree() {
  return PHAROS_SOURCE;
}

const Registry& all_plugins() {
  static const Registry registry = [] {
    Registry result;
    load_modules(result, PHAROS_PLUGINS, true);
    laboratory::add_integrands(result);
    return result;
  }();
  return registry;
}

Workbench::Workbench() {
  fs::copy(source_tree() / "configs", path() / "configs", fs::copy_options::recursive);
  fs::create_directory_symlink(source_tree() / "scenes", path() / "scenes");
}

bool Workbench::has(const std::string& name) const {
  return fs::exists(path() / name) || fs::exists(source_tree() / name);
}

testing::Outcome Workbench::run(const std::string& arguments) const {
  return testing::run_pharos(arguments, path(), "PHAROS_MODULE_PATH='" PHAROS_TEST_PLUGINS "'");
}

}  // namespace pharos::docs
