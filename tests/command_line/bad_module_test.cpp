// Module folders and libraries that the program must refuse.

#include <doctest/doctest.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

Mistake with_modules(const std::string& folder) {
  return {.arguments = "plugins", .environment = "PHAROS_MODULE_PATH=" + folder};
}

TEST_CASE("module folders") {
  check_refused(with_modules("/no/such/folder"), {"/no/such/folder: error: ", "does not exist"});
  check_refused(with_modules("/etc/passwd"), {"/etc/passwd: error: ", "found a file"});
}

TEST_CASE("libraries that are no modules") {
  Mistake text = with_modules(".");
  text.prepare = [](const ScratchFolder& f) { f.write("text.pharos.so", "no library\n"); };
  check_refused(text, {"text.pharos.so: error: ", "cannot be loaded"});
  Mistake folder = with_modules(".");
  folder.prepare = [](const ScratchFolder& f) {
    std::filesystem::create_directory(f.path() / "folder.pharos.so");
  };
  check_refused(folder, {"folder.pharos.so: error: ", "found a folder"});
  Mistake lost = with_modules(".");
  lost.prepare = [](const ScratchFolder& f) {
    std::filesystem::create_symlink("nowhere", f.path() / "lost.pharos.so");
  };
  check_refused(lost, {"lost.pharos.so: error: ", "no such file"});
}

TEST_CASE("modules that do not fit this program") {
  const std::string folder = PHAROS_WRONG_MODULES;
  check_refused(with_modules(folder + "/other_abi"),
                {"other_abi.pharos.so: error: ", "ABI version 9999", "build it again"});
  check_refused(with_modules(folder + "/no_registration"),
                {"no_registration.pharos.so: error: ", "'pharos_module_register'"});
  check_refused(with_modules(folder + "/taken_name"),
                {"taken_name.pharos.so: error: ", "filter 'box'", "module 'filters'"});
  check_refused(
      {.arguments = "synthesize", .environment = "PHAROS_MODULE_PATH=" + folder + "/taken_command"},
      {"module 'taken_command'", "command 'render'"});
}

}  // namespace
}  // namespace pharos::testing
