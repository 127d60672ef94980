#pragma once

#include <pharos/scene/importer.h>

#include "../document/document.h"

namespace pharos::mitsuba {

/// Maps a Mitsuba scene to a render config. Differences in the rendered result become notes. Throws
/// InputError, located in the scene file, for types of plugins that Mitsuba does not have (with the
/// nearest type) or that have no counterpart, properties of the wrong kind, missing file names, and
/// objects nested deeper than 64.
Import map_document(const Document& document);

}  // namespace pharos::mitsuba
