// grid: lines of `color1` on a ground of `color0`. Lines lie where a scaled texture coordinate is
// within `line_width` of a whole number. A line is thus twice as wide as `line_width`, half on
// either side (as in Mitsuba's gridtexture), and with 0.5 nothing of the ground is left.
//
//     { type: grid, color0: 0.8, color1: [0.1, 0.1, 0.3], line_width: 0.03, uv_scale: [10, 10] }
#include "grid.h"

namespace pharos {

void GridTexture::Settings::describe(Schema<Settings>& s) {
  s.field("color0", &Settings::color0, "Color of the ground").at_least(0);
  s.field("color1", &Settings::color1, "Color of the lines").at_least(0);
  s.field("line_width", &Settings::line_width,
          "Half the width of a line, relative to the width of a cell")
      .at_least(0)
      .at_most(0.5);
  s.field("uv_scale", &Settings::uv_scale, "Factors on the texture coordinates");
  s.example("{ color0: [0.9, 0.8, 0.7], color1: 0, line_width: 0.1, uv_scale: [7, 3] }");
}

Rgb GridTexture::value_at(const SurfacePoint& point) const {
  const bool line =
      on_line(point.uv.x * settings_.uv_scale.x) || on_line(point.uv.y * settings_.uv_scale.y);
  return line ? settings_.color1 : settings_.color0;
}

bool GridTexture::on_line(float coordinate) const {
  return std::abs(coordinate - std::round(coordinate)) < settings_.line_width;
}

Rgb GridTexture::average() const {
  const float ground = square(1 - 2 * settings_.line_width);
  return ground * settings_.color0 + (1 - ground) * settings_.color1;
}

}  // namespace pharos
