#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// What stands for an integrator: `path`, with a note where Mitsuba's is another one. All of them
/// estimate the same image, so that types that are not known are replaced as well.
ConfigNode map_integrator(SceneMap& scene, const Object& integrator);

/// The same for scenes that state none: direct light in dialect 0.x, all light in 2 and 3.
ConfigNode default_integrator(SceneMap& scene, const Location& where);

}  // namespace pharos::mitsuba
