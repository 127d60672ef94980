#pragma once

#include <string>

#include <pharos/config/registry.h>

namespace pharos {

/// Stands for the code that renders a config: the content of libpharos and of the modules whose
/// plugins `resolved` names. Modules that only share a plugin's name with it count too.
std::string build_key(const ConfigNode& resolved, const Registry& registry);

}  // namespace pharos
