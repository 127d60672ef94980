#pragma once

#include <pharos/core/transform.h>

#include "element.h"
#include "names.h"

namespace pharos::mitsuba {

/// Returns the map of a `transform`: its steps (`translate`, `rotate`, `scale`, `lookat`, `matrix`)
/// in order, the first one applied first. The caller checks the attributes of the element itself.
/// Throws InputError for maps without an inverse and for matrices that are not affine.
Transform read_transform(const Element& element, Variables& variables, Dialect dialect);

/// Returns the map of an `animation` at its earliest time. Later times are not read.
Transform read_animation(const Element& element, Variables& variables, Dialect dialect);

}  // namespace pharos::mitsuba
