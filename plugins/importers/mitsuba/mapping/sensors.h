#pragma once

#include "film.h"
#include "part.h"

namespace pharos::mitsuba {

/// The nodes for a sensor and the objects in it.
struct Camera {
  ConfigNode sensor;
  ConfigNode medium;  ///< around it; null: none
  FilmParts film;
  ConfigNode sampler;
  ConfigNode budget;
};

/// Throws InputError for sensors that have no counterpart.
Camera map_sensor(SceneMap& scene, const Object& sensor);

}  // namespace pharos::mitsuba
