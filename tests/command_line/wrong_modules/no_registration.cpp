// A module that registers nothing.
#include <pharos/config/module.h>

extern "C" PHAROS_EXPORT int pharos_module_abi_version() {
  return pharos::kAbiVersion;
}
