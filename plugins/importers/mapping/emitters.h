#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// The emitter of a shape. Throws InputError when it is not one that shapes have.
ConfigNode map_shape_emitter(SceneMap& scene, const Object& emitter, UvSense sense);

/// Appends to `entries` what stands for an emitter without a shape.
void map_emitter(SceneMap& scene, const Object& emitter, std::vector<ConfigNode>& entries);

}  // namespace pharos::mitsuba
