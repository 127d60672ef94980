#pragma once

#include "film.h"
#include "part.h"

namespace pharos::mitsuba {

/// What stands for a sensor and what it holds.
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
