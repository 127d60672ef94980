#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// The nodes for a film.
struct FilmParts {
  ConfigNode film;
  ConfigNode output;          ///< null if the film does not specify it
  int width = 0, height = 0;  ///< of the whole image, before cropping [pixels]
};

/// Maps a film. If `film` is null, maps Mitsuba's default film, located at `where`.
FilmParts map_film(SceneMap& scene, const Object* film, const Location& where);

}  // namespace pharos::mitsuba
