#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Sets `alpha`, `distribution` and `masking` as Mitsuba has them, of a material whose lobe is
/// round here. Other distributions than GGX and Beckmann's are approximated, with a note.
void set_isotropic_roughness(Part& part, ConfigNode& node);

/// The same for materials that may be brushed: `alpha_v` where it differs along v.
void set_roughness(Part& part, ConfigNode& node);

}  // namespace pharos::mitsuba
