#pragma once

#include <memory>

#include <pharos/rendering/film.h>
#include <pharos/scene/sensor.h>

namespace pharos {

/// Restricts `whole`, the sensor of a film of `width` x `height` pixels, to paths that start in
/// `window`. Film positions still refer to the whole film. Directions outside the window are off
/// the film, and densities are for film positions that are uniform in the window.
std::unique_ptr<const PreparedSensor> window_sensor(std::unique_ptr<const PreparedSensor> whole,
                                                    int width, int height, const PixelRect& window);

}  // namespace pharos
