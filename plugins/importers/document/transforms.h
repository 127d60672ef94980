#pragma once

#include <pharos/core/transform.h>

#include "element.h"
#include "names.h"

namespace pharos::mitsuba {

/// The map of a `transform`: its steps (`translate`, `rotate`, `scale`, `lookat`, `matrix`), the
/// first applied first. Attributes of the element itself are the caller's. Throws InputError for
/// maps that have no inverse, and for matrices that are not affine.
Transform read_transform(const Element& element, Variables& variables, Dialect dialect);

/// The map of an `animation` at its earliest time, which is all that is read of it.
Transform read_animation(const Element& element, Variables& variables, Dialect dialect);

}  // namespace pharos::mitsuba
