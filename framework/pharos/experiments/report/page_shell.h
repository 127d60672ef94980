#pragma once

#include <string_view>

namespace pharos {

/// Returns the page without its data: page.html with the styles, scripts and the chart library that
/// embed.cmake writes into it. The placeholders `@title@` and `@data@` occur once each.
std::string_view page_shell();

}  // namespace pharos
