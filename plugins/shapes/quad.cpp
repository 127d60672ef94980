// quad: the square [-1,1]^2 of the xy plane, transformed to world space by any affine map. It faces
// local +z, even under maps that mirror. Texture coordinates cover [0,1]^2 with local x and y.
//
//     type: quad
//     to_world: [ { scale: 0.5 }, { rotate: { axis: [1, 0, 0], degrees: 180 } },
//                 { translate: [0, 0, 2] } ]
//     emitter: { type: area, radiance: 10 }

#include "quad.h"

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
  s.field("to_world", &Settings::to_world, "Transform from the square to world space");
  s.field("flip_normals", &Settings::flip_normals, "Make the quad face -z instead of +z");
  s.example("{ to_world: { matrix: [1.5, 0.4, 0.2, 0.3, 0, 0.8, -0.3, 1, 0.1, 0.2, 1.1, -2] } }");
}

Quad::Quad(const Settings& settings)
    : TriangleShape(transformed(unit_square(), settings.to_world, settings.flip_normals), "quad"),
      corner_(settings.to_world.point({-1, -1, 0})),
      edge_u_(settings.to_world.vector({2, 0, 0})),
      edge_v_(settings.to_world.vector({0, 2, 0})),
      common_(mesh()->surface_point(0, 0.25f, 0.5f)) {}

ShapeSample Quad::sample(Vec2 u) const {
  ShapeSample sample{.point = common_, .pdf = 1 / area()};
  sample.point.position = corner_ + u.x * edge_u_ + u.y * edge_v_;
  sample.point.uv = u;
  sample.point.primitive = u.x >= u.y ? 0 : 1;  // below or above the diagonal
  return sample;
}

}  // namespace pharos
