#pragma once

#include <pharos/core/image.h>
#include <pharos/experiments/pictures/density_slice.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// Draws where the scene's surfaces cross a slice, in one channel "Y": the fraction of each pixel
/// that a line two pixels wide covers, 0 to 1. Rays within the plane, through the pixels' centers
/// along rows and columns in both directions, mark the surfaces they hit. Surfaces that lie within
/// the plane are not hit. If surfaces are closer to each other than half a pixel, one may represent
/// all.
Image scene_outline(const Scene& scene, const SlicePlane& plane);

/// Draws white over `colors` (three channels, linear) with the opacity `coverage`, which has the
/// same size.
void draw_over(Image& colors, const Image& coverage);

}  // namespace pharos
