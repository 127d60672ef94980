#pragma once

#include <pharos/core/image.h>
#include <pharos/experiments/pictures/density_slice.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// Where the scene's surfaces cross a slice: how much of each pixel a line two pixels wide covers,
/// 0 to 1; one channel, "Y". Rays within the plane, through the pixels' centres along its rows and
/// its columns, in both directions, mark what they meet. Surfaces that lie within the plane are not
/// met. Of surfaces that are nearer to each other than half a pixel one may stand for all.
Image scene_outline(const Scene& scene, const SlicePlane& plane);

/// Draws white over `colors` (three channels, linear) as far as `coverage`, of the same size, says.
void draw_over(Image& colors, const Image& coverage);

}  // namespace pharos
