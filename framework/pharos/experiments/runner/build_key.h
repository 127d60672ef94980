#pragma once

#include <string>

#include <pharos/config/registry.h>

namespace pharos {

/// Returns a key of the code that renders a config: the content of libpharos and of the modules
/// whose plugins `resolved` names. A module also counts if any value of the config happens to equal
/// the name of one of its plugins.
std::string build_key(const ConfigNode& resolved, const Registry& registry);

/// Throws RunError if `expected`, the build_key() of the process that ordered a render, is not the
/// one of this process.
void check_build(const ConfigNode& resolved, const std::string& expected, const Registry& registry);

}  // namespace pharos
