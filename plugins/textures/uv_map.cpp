// uv_map: a texture that is moved, rotated, mirrored or stretched. It is looked up at
//
//     u' = a u + b v + c
//     v' = d u + e v + f,        matrix: [a, b, c, d, e, f],
//
// instead of (u, v). Its maximum and average are the maximum and average of the nested texture.
// They are exact for a texture that repeats as a whole, and approximate if the map shows only a
// part of it.
//
//     { type: uv_map, matrix: [0, -2, 0.5, 2, 0, 0], texture: { type: bitmap, file: wood.png } }
#include "uv_map.h"

#include <pharos/core/error.h>

namespace pharos {

void UvMapTexture::Settings::describe(Schema<Settings>& s) {
  s.field("texture", &Settings::texture, "Texture that is moved").required();
  s.field("matrix", &Settings::matrix,
          "Six numbers: the two rows of the matrix that multiplies (u, v, 1)");
  s.example("{ texture: { type: checkerboard }, matrix: [1, 0, 0.5, 0, -1, 0.25] }");
  s.example("{ texture: { type: grid, line_width: 0.2 }, matrix: [0, -2, 0, 3, 1, 0.1] }");
}

UvMapTexture::UvMapTexture(Settings settings) : settings_(std::move(settings)) {
  if (settings_.matrix.size() != 6) throw InputError("uv_map: 'matrix' must have six numbers");
}

Rgb UvMapTexture::value_at(const SurfacePoint& point) const {
  const std::vector<float>& m = settings_.matrix;
  SurfacePoint moved = point;
  moved.uv = {m[0] * point.uv.x + m[1] * point.uv.y + m[2],
              m[3] * point.uv.x + m[4] * point.uv.y + m[5]};
  return settings_.texture->evaluate(moved);
}

}  // namespace pharos
