#pragma once

#include <pharos/config/registry.h>
#include <pharos/core/export.h>

namespace pharos {

/// The version of the binary interface. It changes with the binary interface of any contract.
/// Modules built for another version are refused.
inline constexpr int kAbiVersion = 24;

}  // namespace pharos

/// Begins the only registration function of a module's shared library:
///
///     PHAROS_MODULE(registry) { registry.add<MySampler>("mine", "What it does in one line"); }
#define PHAROS_MODULE(registry)                              \
  extern "C" PHAROS_EXPORT int pharos_module_abi_version() { \
    return ::pharos::kAbiVersion;                            \
  }                                                          \
  extern "C" PHAROS_EXPORT void pharos_module_register(::pharos::Registry& registry)
