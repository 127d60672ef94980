#pragma once

#include <string>
#include <vector>

#include "source_pages.h"

namespace pharos::docs {

/// Returns a line for each link to a file that does not exist, and for each anchor that no heading
/// of its page has. Links to other hosts are not followed.
std::vector<std::string> dead_links(const SourcePages& pages);

}  // namespace pharos::docs
