#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// The node that stands for a medium; none while Pharos has nothing for it, which a note tells. The
/// medium's parameters are read and checked all the same.
std::optional<ConfigNode> map_medium(SceneMap& scene, const Object& medium);

}  // namespace pharos::mitsuba
