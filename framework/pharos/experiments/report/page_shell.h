#pragma once

#include <string_view>

namespace pharos {

/// The page without its data: page.html with styles, scripts and the chart library written into it
/// by embed.cmake. `@title@` and `@data@` stand where those go, once each.
std::string_view page_shell();

}  // namespace pharos
