#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Maps an integrator to `path`, with a note if Mitsuba's integrator is another one. All
/// integrators estimate the same image, so unknown types are replaced as well.
ConfigNode map_integrator(SceneMap& scene, const Object& integrator);

/// The same for scenes without an integrator: direct light in dialect 0.x, all light in 2 and 3.
ConfigNode default_integrator(SceneMap& scene, const Location& where);

}  // namespace pharos::mitsuba
