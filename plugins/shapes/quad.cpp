// quad: the square [-1,1]^2 of the xy plane, taken to world space by any affine map. It faces local
// +z, mirrored or not, and texture coordinates run over [0,1]^2 with local x and y.
//
//     type: quad
//     to_world: [ { scale: 0.5 }, { rotate: { axis: [1, 0, 0], degrees: 180 } },
//                 { translate: [0, 0, 2] } ]
//     emitter: { type: area, radiance: 10 }

#include "quad.h"

#include <utility>

namespace pharos {
namespace {

TriangleMesh unit_square() {
  TriangleMesh square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  return square;
}

}  // namespace

void Quad::Settings::describe(Schema<Settings>& s) {
  s.field("to_world", &Settings::to_world, "From the square to world space");
  s.field("flip_normals", &Settings::flip_normals, "Face -z instead of +z");
}

Quad::Quad(const Settings& settings)
    : TriangleShape(transformed(unit_square(), settings.to_world, settings.flip_normals), "quad"),
      wound_backwards_(settings.to_world.flips_handedness() != settings.flip_normals) {}

ShapeSample Quad::sample(Vec2 u) const {
  const bool first = u.x >= u.y;  // the triangle below the diagonal from corner 0 to corner 2
  Vec2 b = first ? Vec2{u.x - u.y, u.y} : Vec2{u.x, u.y - u.x};
  if (wound_backwards_) std::swap(b.x, b.y);
  return sample_at(first ? 0 : 1, b);
}

}  // namespace pharos
