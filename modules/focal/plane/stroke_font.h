#pragma once

#include <vector>

#include "quadtree.h"

namespace pharos::focal::plane {

/// The height from the base line to the top of 'l' [font units].
inline constexpr double kCapHeight = 10;

/// A letter as a set of polylines [font units], with y upward from the base line.
struct Glyph {
  std::vector<std::vector<Point2>> strokes;
  double advance = 0;  ///< distance to the next letter
};

/// Returns a letter of the font, which contains the letters of the picture's labels. Throws
/// InputError for other letters.
Glyph glyph_of(char letter);

}  // namespace pharos::focal::plane
