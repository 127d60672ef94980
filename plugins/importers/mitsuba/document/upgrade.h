#pragma once

#include <string_view>

#include "document.h"

namespace pharos::mitsuba {

/// Converts an object with the old tag `luminaire` or `camera`, used by Mitsuba before 0.4, to the
/// conventions of `emitter` or `sensor`: names of intensities, the axis of the field of view, and
/// the handedness of the camera. Other objects remain unchanged.
void upgrade(Object& object, std::string_view written_tag);

}  // namespace pharos::mitsuba
