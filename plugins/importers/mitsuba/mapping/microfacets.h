#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Sets `alpha`, `distribution` and `masking` in accordance with Mitsuba, for a material that is
/// isotropic in Pharos. Distributions other than GGX and Beckmann are approximated, with a note.
void set_isotropic_roughness(Part& part, ConfigNode& node);

/// The same for materials that may be anisotropic. Sets `alpha_v` if the roughness differs along v.
void set_roughness(Part& part, ConfigNode& node);

}  // namespace pharos::mitsuba
