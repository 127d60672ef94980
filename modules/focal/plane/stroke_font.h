#pragma once

#include <vector>

#include "quadtree.h"

namespace pharos::focal::plane {

/// From the base line to the top of 'l' [font units].
inline constexpr double kCapHeight = 10;

/// A letter as lines [font units], y upwards from the base line.
struct Glyph {
  std::vector<std::vector<Point2>> strokes;
  double advance = 0;  ///< to the next letter
};

/// A letter of the font, which has those that the picture's labels need. Throws InputError for
/// others.
Glyph glyph_of(char letter);

}  // namespace pharos::focal::plane
