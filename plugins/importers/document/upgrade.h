#pragma once

#include <string_view>

#include "document.h"

namespace pharos::mitsuba {

/// Brings an object whose tag was written `luminaire` or `camera`, as Mitsuba before 0.4 did, to
/// what it says as `emitter` or `sensor`: names of intensities, the axis of the field of view, and
/// the camera's handedness. Other objects stay.
void upgrade(Object& object, std::string_view written_tag);

}  // namespace pharos::mitsuba
