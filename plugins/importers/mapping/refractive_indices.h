#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// The refractive index that `name` states, as a number or as the name of a material such as
/// "water"; `otherwise` is used when it does not. Throws InputError for unknown materials.
double refractive_index(Part& part, std::string_view name, double otherwise);

/// `int_ior` over `ext_ior`, air unless stated. `inside` is the default of the former.
ConfigNode relative_ior(Part& part, double inside);

constexpr double kIorOfBk7 = 1.5046, kIorOfPolypropylene = 1.49, kIorOfAir = 1.000277;

}  // namespace pharos::mitsuba
