#pragma once

#include <string>

namespace pharos {

/// The version of libpharos, such as "0.1.0".
std::string version();

}  // namespace pharos
