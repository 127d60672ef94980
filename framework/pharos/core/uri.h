#pragma once

#include <string>
#include <string_view>

namespace pharos {

/// Decodes the percent signs of a URI, in which "%20" is a blank. glTF stores file names as URIs.
std::string percent_decoded(std::string_view text);

}  // namespace pharos
