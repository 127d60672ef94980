#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// What stands for a film.
struct FilmParts {
  ConfigNode film;
  ConfigNode output;          ///< null when the film says nothing about it
  int width = 0, height = 0;  ///< of the whole image, before it is cut [pixels]
};

/// `film` may be null; the film is then Mitsuba's default, located at `where`.
FilmParts map_film(SceneMap& scene, const Object* film, const Location& where);

}  // namespace pharos::mitsuba
