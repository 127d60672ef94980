#pragma once

#include <vector>

#include <pharos/scene/importer.h>

namespace pharos {

/// Warns of what was approximated, a line each; when `strict`, throws InputError for the first.
void tell_notes(const std::vector<ImportNote>& notes, bool strict);

}  // namespace pharos
