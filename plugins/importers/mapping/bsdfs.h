#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// The node that stands for a BSDF: its name if it has an id, else the material in place.
ConfigNode map_bsdf(SceneMap& scene, const Object& bsdf, UvSense sense, const Location& where);

/// The BSDFs nested in `part`, each as the node of a material. Throws InputError unless there are
/// `least` to `most`.
std::vector<ConfigNode> nested_bsdfs(Part& part, std::size_t least, std::size_t most);

// What stands for each type; see docs/mitsuba.md.
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
/// Throws InputError: there is nothing like it here.
ConfigNode map_without_counterpart(Part& part);

}  // namespace pharos::mitsuba
