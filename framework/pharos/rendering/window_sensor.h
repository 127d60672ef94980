#pragma once

#include <memory>

#include <pharos/rendering/film.h>
#include <pharos/scene/sensor.h>

namespace pharos {

/// `whole`, the sensor of a film of `width` x `height` pixels, where paths start in `window` alone:
/// film positions remain those of the whole film, directions that lead beside the window are off
/// the film, and densities are those of positions uniform in the window.
std::unique_ptr<const PreparedSensor> window_sensor(std::unique_ptr<const PreparedSensor> whole,
                                                    int width, int height, const PixelRect& window);

}  // namespace pharos
