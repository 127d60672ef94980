// box: the cube [-1,1]^3, transformed to world space by any affine map. Normals point outwards
// unless flipped (for a room, or an emitting box seen from inside). Texture coordinates cover
// [0,1]^2 on every face.
//
//     type: box
//     to_world: { scale: [2, 1, 0.5] }

#include "box.h"

namespace pharos {
namespace {

Vec3 axis_vector(int axis, float value) {
  Vec3 v;
  v[axis % 3] = value;
  return v;
}

/// Adds the face whose outward normal is `sign` times the axis. Its edges u and v satisfy u x v =
/// normal.
void add_face(TriangleMesh& cube, int axis, float sign) {
  const Vec3 normal = axis_vector(axis, sign);
  const Vec3 u = axis_vector(axis + 1, 1), v = axis_vector(axis + 2, sign);
  const auto first = static_cast<std::uint32_t>(cube.positions.size());
  for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
    cube.positions.push_back(normal + (2 * uv.x - 1) * u + (2 * uv.y - 1) * v);
    cube.uvs.push_back(uv);
  }
  cube.triangles.push_back({first, first + 1, first + 2});
  cube.triangles.push_back({first, first + 2, first + 3});
}

TriangleMesh unit_cube() {
  TriangleMesh cube;
  for (int axis = 0; axis < 3; ++axis) {
    add_face(cube, axis, 1);
    add_face(cube, axis, -1);
  }
  return cube;
}

}  // namespace

void Box::Settings::describe(Schema<Settings>& s) {
  s.field("to_world", &Settings::to_world, "Transform from the cube to world space");
  s.field("flip_normals", &Settings::flip_normals, "Make normals point inwards");
  s.example("{ to_world: { scale: [2, 1, -0.5] } }");
}

Box::Box(const Settings& settings)
    : TriangleShape(transformed(unit_cube(), settings.to_world, settings.flip_normals), "box") {}

}  // namespace pharos
