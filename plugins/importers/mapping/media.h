#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// The name among `media` of what stands for a medium; none for kinds that Pharos has nothing for,
/// which a note tells. Their parameters are read and checked all the same.
std::optional<ConfigNode> map_medium(SceneMap& scene, const Object& medium);

}  // namespace pharos::mitsuba
