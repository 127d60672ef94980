// Hierarchy, parts, orientation and texture coordinates of glTF files, written here and read in the
// same way as other meshes.

#include <array>
#include <cstring>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../mesh.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

/// A right triangle in the plane z = 0, its tilted normal, and its texture coordinates as in glTF,
/// with v from the top. The same triangle follows, one unit higher.
struct Buffer {
  std::array<Point3, 3> low{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  std::array<Vec3, 3> normals{{{0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}}};
  std::array<Vec2, 3> uvs{{{0, 1}, {1, 1}, {0, 0.25f}}};
  std::array<std::uint32_t, 3> indices{0, 1, 2};
  std::array<Point3, 3> high{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};

  std::string bytes() const {
    std::string text(sizeof(Buffer), '\0');
    std::memcpy(text.data(), this, sizeof(Buffer));
    return text;
  }
};
static_assert(sizeof(Buffer) == 36 + 36 + 24 + 12 + 36);

/// A boat at x = 10: its sail at twice the size, the same sail mirrored and stretched along z, and
/// a deck without normals and texture coordinates.
std::string boat_json(const std::string& uri) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [
    {"name": "boat", "translation": [10, 0, 0], "children": [1, 2, 3]},
    {"name": "mast", "scale": [2, 2, 2], "mesh": 0},
    {"name": "reflection", "scale": [-1, 1, 2], "mesh": 0},
    {"name": "hull", "mesh": 1}],
  "meshes": [
    {"name": "sail", "primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}]},
    {"name": "deck", "primitives": [{"attributes": {"POSITION": 4}, "indices": 3}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
     "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"},
    {"bufferView": 3, "componentType": 5125, "count": 3, "type": "SCALAR"},
    {"bufferView": 4, "componentType": 5126, "count": 3, "type": "VEC3",
     "min": [0, 0, 1], "max": [1, 1, 1]}],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 36},
    {"buffer": 0, "byteOffset": 36, "byteLength": 36},
    {"buffer": 0, "byteOffset": 72, "byteLength": 24},
    {"buffer": 0, "byteOffset": 96, "byteLength": 12},
    {"buffer": 0, "byteOffset": 108, "byteLength": 36}],
  "buffers": [{)" +
         (uri.empty() ? "" : "\"uri\": \"" + uri + "\", ") + R"("byteLength": 144}]})";
}

std::string boat_gltf() {
  return boat_json(test::data_uri(Buffer{}.bytes()));
}

std::string boat_glb() {
  return test::glb(boat_json(""), Buffer{}.bytes());
}

/// A boat in its own file, as text and as binary.
struct Boats {
  test::TemporaryFolder folder;
  std::array<std::filesystem::path, 2> paths{folder.write("boat.gltf", boat_gltf()),
                                             folder.write("boat.glb", boat_glb())};
};

/// Returns the surface of the triangle at its vertices 0, 1 and 2.
std::array<SurfacePoint, 3> corners(const Mesh& mesh, std::uint32_t triangle) {
  const TriangleMesh& m = *mesh.mesh();
  return {m.surface_point(triangle, 0, 0), m.surface_point(triangle, 1, 0),
          m.surface_point(triangle, 0, 1)};
}

void check_near(Vec3 a, Vec3 b, float apart = 1e-5f) {
  INFO(a.x, " ", a.y, " ", a.z, " against ", b.x, " ", b.y, " ", b.z);
  CHECK(length(a - b) < apart);
}

/// Checks a point at a corner of at least 45 degrees. Points lie twice their error away from both
/// edges, which is 2 / sin(22.5 degrees) = 5.2 errors away from the corner.
void check_corner(const SurfacePoint& point, Point3 corner) {
  check_near(point.position, corner, 6 * point.error);
}

TEST_CASE("the transforms of all nodes above a mesh apply to it") {
  const Boats boats;
  for (const auto& path : boats.paths) {
    const Mesh whole({.file = path});
    CHECK(whole.primitive_count() == 3);
    CHECK(whole.area() == doctest::Approx(0.5 * (4 + 1 + 1)));
    CHECK(whole.bounds().low == Point3{9, 0, 0});
    CHECK(whole.bounds().high == Point3{12, 2, 1});

    const auto sail = corners(Mesh({.file = path, .part = "mast"}), 0);
    check_corner(sail[0], {10, 0, 0});
    check_corner(sail[1], {12, 0, 0});
    check_corner(sail[2], {10, 2, 0});
    CHECK(sail[0].normal.z == 1);
    check_near(sail[0].shading.n, {0.6f, 0, 0.8f});
  }
}

TEST_CASE(
    "a mirrored node keeps the outer side outside and turns normals by the inverse transpose") {
  const Boats boats;
  for (const auto& path : boats.paths) {
    const Mesh mirrored({.file = path, .part = "reflection"});
    CHECK(mirrored.primitive_count() == 1);
    const SurfacePoint p = mirrored.mesh()->surface_point(0, 0.3f, 0.3f);
    CHECK(p.normal.z == 1);
    CHECK(p.position.x < 10);
    check_near(p.shading.n, normalize(Vec3{-0.6f, 0, 0.4f}));
  }
}

TEST_CASE("pictures appear as the file's author saw them, v running from the bottom") {
  const Boats boats;
  for (const auto& path : boats.paths) {
    const auto sail = corners(Mesh({.file = path, .part = "mast"}), 0);
    CHECK(sail[0].uv.x == doctest::Approx(0));
    CHECK(sail[0].uv.y == doctest::Approx(0));
    CHECK(sail[1].uv.x == doctest::Approx(1));
    CHECK(sail[2].uv.y == doctest::Approx(0.75));
  }
}

TEST_CASE("a part is a mesh wherever it is placed, or a node with all below it") {
  const Boats boats;
  for (const auto& path : boats.paths) {
    CHECK(Mesh({.file = path, .part = "sail"}).primitive_count() == 2);
    CHECK(Mesh({.file = path, .part = "boat"}).primitive_count() == 3);
    const Mesh deck({.file = path, .part = "deck"});
    CHECK(deck.primitive_count() == 1);
    CHECK(deck.bounds().low == Point3{10, 0, 1});
    CHECK(deck.mesh()->normals.empty());  // unlike in the whole boat
    CHECK(deck.mesh()->uvs.empty());
    const Mesh flat({.file = path, .part = "sail", .normals = MeshNormals::flat});
    CHECK(flat.mesh()->normals.empty());
  }
}

TEST_CASE("a part that a file lacks is an error with the nearest name and a list") {
  const Boats boats;
  const std::string message =
      test::input_error_in(boats.folder, [&] { Mesh({.file = boats.paths[0], .part = "sial"}); });
  CHECK(message ==
        "mesh 'boat.gltf': it has no part 'sial' (did you mean 'sail'?); its parts are "
        "'boat', 'deck', 'hull', 'mast', 'reflection', 'sail'");
}

}  // namespace
}  // namespace pharos
