#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Maps a medium and returns its name in `media`. Returns nothing and adds a note for media that
/// Pharos does not support. Their parameters are read and checked all the same.
std::optional<ConfigNode> map_medium(SceneMap& scene, const Object& medium);

}  // namespace pharos::mitsuba
