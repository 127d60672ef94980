// checkerboard: squares of two colors. One unit of scaled texture coordinates contains two by two
// squares: `color0` where u and v lie in the same half of their unit, `color1` elsewhere.
//
//     { type: checkerboard, color0: 0.7, color1: [0.2, 0.1, 0.1], uv_scale: [8, 8] }
#include "checkerboard.h"

namespace pharos {
namespace {

bool in_upper_half(float x) {
  return x - std::floor(x) >= 0.5f;
}

}  // namespace

void Checkerboard::Settings::describe(Schema<Settings>& s) {
  s.field("color0", &Settings::color0, "Color of the square at the origin").at_least(0);
  s.field("color1", &Settings::color1, "Color of the neighboring squares").at_least(0);
  s.field("uv_scale", &Settings::uv_scale, "Factors on the texture coordinates");
  s.example("{ color0: [0.9, 0.1, 0.3], color1: 0, uv_scale: [4, 2.5] }");
}

Rgb Checkerboard::value_at(const SurfacePoint& point) const {
  const bool same = in_upper_half(point.uv.x * settings_.uv_scale.x) ==
                    in_upper_half(point.uv.y * settings_.uv_scale.y);
  return same ? settings_.color0 : settings_.color1;
}

}  // namespace pharos
