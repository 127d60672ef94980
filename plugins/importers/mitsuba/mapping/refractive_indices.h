#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Returns the refractive index that `name` gives, as a number or as the name of a material such as
/// "water"; `otherwise` if it is missing. Throws InputError for unknown materials.
double refractive_index(Part& part, std::string_view name, double otherwise);

/// Returns `int_ior` divided by `ext_ior`. The default of `int_ior` is `inside`, the default of
/// `ext_ior` is air.
ConfigNode relative_ior(Part& part, double inside);

constexpr double kIorOfBk7 = 1.5046, kIorOfPolypropylene = 1.49, kIorOfAir = 1.000277;

}  // namespace pharos::mitsuba
