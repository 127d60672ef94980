#pragma once

#include <vector>

#include <pharos/scene/importer.h>

namespace pharos {

/// Warns of each approximation on a line of its own. If `strict`, throws InputError for the first
/// one.
void tell_notes(const std::vector<ImportNote>& notes, bool strict);

}  // namespace pharos
