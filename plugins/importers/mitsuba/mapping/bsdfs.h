#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Returns the node for a BSDF: its name if it has an id, otherwise the material itself.
ConfigNode map_bsdf(SceneMap& scene, const Object& bsdf, UvSense sense, const Location& where);

/// Returns a material node for each BSDF nested in `part`. Throws InputError unless there are
/// `least` to `most` of them.
std::vector<ConfigNode> nested_bsdfs(Part& part, std::size_t least, std::size_t most);

// These functions map a BSDF of each type; see docs/mitsuba.md.
ConfigNode map_diffuse(Part& part);
ConfigNode map_rough_diffuse(Part& part);
ConfigNode map_diffuse_transmitter(Part& part);
ConfigNode map_conductor(Part& part);
ConfigNode map_rough_conductor(Part& part);
ConfigNode map_dielectric(Part& part);
ConfigNode map_thin_dielectric(Part& part);
ConfigNode map_rough_dielectric(Part& part);
ConfigNode map_plastic(Part& part);
ConfigNode map_rough_plastic(Part& part);
ConfigNode map_phong(Part& part);
ConfigNode map_ward(Part& part);
ConfigNode map_principled(Part& part);
ConfigNode map_principled_thin(Part& part);
ConfigNode map_null(Part& part);
ConfigNode map_two_sided(Part& part);
ConfigNode map_mask(Part& part);
ConfigNode map_blend(Part& part);
ConfigNode map_mixture(Part& part);
ConfigNode map_bump(Part& part);
ConfigNode map_normal_map(Part& part);
ConfigNode map_coating(Part& part);
/// Throws InputError, because Pharos has nothing similar.
ConfigNode map_without_counterpart(Part& part);

}  // namespace pharos::mitsuba
