#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/values.h>

namespace pharos {

/// Faults that tests plant into the path integrator, to see which tests notice. Only tests build it
/// with PHAROS_PLANT_FAULTS; anywhere else planted() is false at compile time and leaves no trace.
enum class PlantedFault {
  none,
  mis_without_guide,           ///< emission is weighted with the unguided density alone
  zero_samples_dropped,        ///< paths of value zero do not count in the average
  light_choice_forgotten,      ///< next event estimation omits the probability of its light
  roulette_unweighted,         ///< survivors of roulette do not stand for the others
  distance_density_forgotten,  ///< steps in media omit the density of their distance
  boundaries_cast_shadows,     ///< no light sample gets through the boundary of a medium
};
template <>
struct EnumNames<PlantedFault> {
  static constexpr std::array<std::pair<std::string_view, PlantedFault>, 7> names{
      {{"none", PlantedFault::none},
       {"mis_without_guide", PlantedFault::mis_without_guide},
       {"zero_samples_dropped", PlantedFault::zero_samples_dropped},
       {"light_choice_forgotten", PlantedFault::light_choice_forgotten},
       {"roulette_unweighted", PlantedFault::roulette_unweighted},
       {"distance_density_forgotten", PlantedFault::distance_density_forgotten},
       {"boundaries_cast_shadows", PlantedFault::boundaries_cast_shadows}}};
};

#ifdef PHAROS_PLANT_FAULTS
/// The fault in force, set before a render.
inline PlantedFault planted_fault = PlantedFault::none;
inline bool planted(PlantedFault fault) {
  return planted_fault == fault;
}
#else
constexpr bool planted(PlantedFault) {
  return false;
}
#endif

}  // namespace pharos
