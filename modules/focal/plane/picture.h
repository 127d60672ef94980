#pragma once

#include <span>
#include <string>
#include <vector>

#include <pharos/core/image.h>

#include "guide.h"
#include "quadtree.h"
#include "scene.h"

namespace pharos::focal::plane {

/// What one half of the picture shows.
struct Panel {
  std::string title;               ///< lower-case, of the letters in stroke_font.cpp
  std::vector<Path> paths;         ///< that found light
  std::vector<double> variances;   ///< over the floor, from left to right
  const Quadtree* tree = nullptr;  ///< its density tints the scene; null for none
  Rgb color;                       ///< of its curve and tint, sRGB-encoded
};

/// Figure 8: panels side by side, each the scene with its paths, their opacity in proportion to
/// their value (1 at `full_value`), and below the floor the variance there, on a logarithmic scale
/// that all panels share, with `uniform`, that of uniform sampling, as a dashed line. Linear
/// colors.
Image draw_picture(const GapScene& scene, std::span<const Panel> panels,
                   std::span<const double> uniform, double full_value);

}  // namespace pharos::focal::plane
