// A module that was built for another version of the program.
#include <pharos/config/registry.h>
#include <pharos/core/export.h>

extern "C" PHAROS_EXPORT int pharos_module_abi_version() {
  return 9999;
}
extern "C" PHAROS_EXPORT void pharos_module_register(pharos::Registry&) {}
