#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/values.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// Faults that tests plant into the integrators, to see which tests notice. Only tests build them
/// with PHAROS_PLANT_FAULTS; anywhere else planted() is false at compile time and leaves no trace.
enum class PlantedFault {
  none,
  mis_without_guide,            ///< emission is weighted with the unguided density alone
  zero_samples_dropped,         ///< paths of value zero do not count in the average
  light_choice_forgotten,       ///< next event estimation omits the probability of its light
  roulette_unweighted,          ///< survivors of roulette do not stand for the others
  distance_density_forgotten,   ///< steps in media omit the density of their distance
  boundaries_cast_shadows,      ///< neither light samples nor views get through boundaries of media
  boundaries_count_as_origins,  ///< steps that meet light count as if they began at the last
                                ///< boundary, and all of them as in empty space
  camera_cosine_forgotten,      ///< shining surfaces seen from the lens are not foreshortened
  reverse_density_forgotten,    ///< paths from the lens count as if light paths could not make them
};
template <>
struct EnumNames<PlantedFault> {
  static constexpr std::array<std::pair<std::string_view, PlantedFault>, 10> names{
      {{"none", PlantedFault::none},
       {"mis_without_guide", PlantedFault::mis_without_guide},
       {"zero_samples_dropped", PlantedFault::zero_samples_dropped},
       {"light_choice_forgotten", PlantedFault::light_choice_forgotten},
       {"roulette_unweighted", PlantedFault::roulette_unweighted},
       {"distance_density_forgotten", PlantedFault::distance_density_forgotten},
       {"boundaries_cast_shadows", PlantedFault::boundaries_cast_shadows},
       {"boundaries_count_as_origins", PlantedFault::boundaries_count_as_origins},
       {"camera_cosine_forgotten", PlantedFault::camera_cosine_forgotten},
       {"reverse_density_forgotten", PlantedFault::reverse_density_forgotten}}};
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

/// Where the boundary lies that a step from `from` to `to` passes last; `from` if there is none.
inline Point3 last_boundary(const Scene& scene, Point3 from, const SurfacePoint& to) {
  Point3 last = from;
  for (;;) {
    const Vec3 direction = normalize(to.position - last);
    const Ray ray{last + 1e-3f * direction, direction};
    SurfacePoint at;
    if (std::isinf(scene.intersect(ray, at)) || !scene.is_boundary(at)) return last;
    last = at.position;
  }
}

}  // namespace pharos
