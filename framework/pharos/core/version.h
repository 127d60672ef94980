#pragma once

#include <string>

namespace pharos {

/// Returns the version of libpharos, such as "0.1.0".
std::string version();

}  // namespace pharos
