#pragma once

#include <span>
#include <string_view>

#include <pharos/core/image.h>
#include <pharos/core/rgb.h>

#include "quadtree.h"

namespace pharos::focal::plane {

/// The color of a stroke or a filling. Colors are sRGB-encoded, as is common for drawings.
struct Ink {
  Rgb color;
  double opacity = 1;
};

/// A picture to draw on. Positions are in pixels from the upper left corner, with y downward. Edges
/// are smoothed by the covered share of each pixel. Later strokes cover earlier strokes.
class Canvas {
 public:
  Canvas(int width, int height, Rgb background);

  /// Fills the rectangle between two corners. The upper left corner comes first.
  void rectangle(Point2 corner, Point2 opposite, const Ink& ink);
  void line(Point2 from, Point2 to, double width, const Ink& ink);
  /// Draws a line through all points. At joints of lines, translucent ink is applied twice.
  void polyline(std::span<const Point2> points, double width, const Ink& ink);
  /// Draws letters of a plain stroke font, `height` pixels high from the base line to the top of
  /// 'l'. `at` is the left end of the base line. Returns the width. Throws InputError for a letter
  /// that the font lacks.
  double text(Point2 at, std::string_view letters, double height, const Ink& ink);

  /// Returns the picture with linear colors, for write_png() without exposure and tone curve.
  Image image() const;

 private:
  void blend(int x, int y, const Ink& ink, double coverage);

  Image encoded_;
};

/// Returns the width of Canvas::text() [pixels].
double text_width(std::string_view letters, double height);

}  // namespace pharos::focal::plane
