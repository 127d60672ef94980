#pragma once

#include <span>
#include <string>
#include <vector>

#include <pharos/core/image.h>

#include "guide.h"
#include "quadtree.h"
#include "scene.h"

namespace pharos::focal::plane {

/// The content of one half of the picture.
struct Panel {
  std::string title;               ///< in lower case, with letters of stroke_font.cpp only
  std::vector<Path> paths;         ///< paths that found light
  std::vector<double> variances;   ///< variances over the floor, from left to right
  const Quadtree* tree = nullptr;  ///< quadtree whose density tints the scene; null for none
  Rgb color;                       ///< color of the curve and the tint, sRGB-encoded
};

/// Draws figure 8: panels side by side. Each panel shows the scene with its paths. The opacity of a
/// path is proportional to its value and reaches 1 at `full_value`. Below the floor, the panel
/// shows the variance along the floor on a logarithmic scale that all panels share. The dashed line
/// is `uniform`, the variance of uniform sampling. Colors are linear.
Image draw_picture(const GapScene& scene, std::span<const Panel> panels,
                   std::span<const double> uniform, double full_value);

}  // namespace pharos::focal::plane
