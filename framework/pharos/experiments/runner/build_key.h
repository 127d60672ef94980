#pragma once

#include <string>

#include <pharos/config/registry.h>

namespace pharos {

/// Returns a key of the code that renders a config: the content of libpharos and of the modules
/// whose plugins `resolved` names. A module also counts if any value of the config happens to equal
/// the name of one of its plugins.
std::string build_key(const ConfigNode& resolved, const Registry& registry);

}  // namespace pharos
