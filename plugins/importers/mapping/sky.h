#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// What stands for `sky`, `sun` or `sunsky`: one emitter for each half that it has.
std::vector<ConfigNode> map_daylight(SceneMap& scene, const Object& emitter);

/// Whether an emitter of this type is one of those.
bool is_daylight(std::string_view type);

}  // namespace pharos::mitsuba
