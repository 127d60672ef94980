#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Maps `sky`, `sun` or `sunsky` to one emitter for each part it has.
std::vector<ConfigNode> map_daylight(SceneMap& scene, const Object& emitter);

/// Returns whether the type is one of these.
bool is_daylight(std::string_view type);

}  // namespace pharos::mitsuba
