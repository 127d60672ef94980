#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Maps the emitter of a shape. Throws InputError if shapes cannot have this type of emitter.
ConfigNode map_shape_emitter(SceneMap& scene, const Object& emitter, UvSense sense);

/// Maps an emitter without a shape and appends the result to `entries`.
void map_emitter(SceneMap& scene, const Object& emitter, std::vector<ConfigNode>& entries);

}  // namespace pharos::mitsuba
