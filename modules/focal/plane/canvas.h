#pragma once

#include <span>
#include <string_view>

#include <pharos/core/image.h>
#include <pharos/core/rgb.h>

#include "quadtree.h"

namespace pharos::focal::plane {

/// A stroke or a filling. Colors are sRGB-encoded, as colors of drawings are chosen.
struct Ink {
  Rgb color;
  double opacity = 1;
};

/// A picture that is drawn on: positions in pixels from the upper left corner, y downwards, edges
/// smoothed by the share of each pixel that is covered. Later strokes cover earlier ones.
class Canvas {
 public:
  Canvas(int width, int height, Rgb background);

  /// Between two corners, the upper left one first.
  void rectangle(Point2 corner, Point2 opposite, const Ink& ink);
  void line(Point2 from, Point2 to, double width, const Ink& ink);
  /// Through all points; where lines join, translucent ink is doubled.
  void polyline(std::span<const Point2> points, double width, const Ink& ink);
  /// Letters of a plain stroke font, `height` pixels from the base line to the top of 'l'; `at` is
  /// the left end of the base line. Returns the width. Throws InputError for a letter that the
  /// font lacks.
  double text(Point2 at, std::string_view letters, double height, const Ink& ink);

  /// The picture as linear colors, for write_png() without exposure and tone curve.
  Image image() const;

 private:
  void blend(int x, int y, const Ink& ink, double coverage);

  Image encoded_;
};

/// The width of Canvas::text() [pixels].
double text_width(std::string_view letters, double height);

}  // namespace pharos::focal::plane
