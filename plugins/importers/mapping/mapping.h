#pragma once

#include <pharos/scene/importer.h>

#include "../document/document.h"

namespace pharos::mitsuba {

/// A Mitsuba scene as a render config. What Pharos renders in another way than Mitsuba becomes a
/// note. Throws InputError at the place in the scene file: types of plugins that Mitsuba does not
/// have (with the nearest that it has) or that have no counterpart, properties of the wrong kind,
/// files that are not named, objects nested deeper than 64.
Import map_document(const Document& document);

}  // namespace pharos::mitsuba
