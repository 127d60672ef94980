#include "../vertex_normals.h"

#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/tests/fixtures.h>

#include "../mesh.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

TriangleMesh loaded(const std::string& name, const std::string& text, Mesh::Settings more = {}) {
  const test::TemporaryFolder folder;
  more.file = folder.write(name, text);
  more.normals = MeshNormals::file_or_smooth;
  return *Mesh(more).mesh();
}

/// Returns the largest angle [rad] between a vertex's normal and the expected normal.
template <class Expected>
double largest_error(const TriangleMesh& mesh, const Expected& expected) {
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  double largest = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    CHECK(length(mesh.normals[i]) == doctest::Approx(1));
    const Vec3 right = normalize(expected(mesh.positions[i]));
    largest = std::max(largest, double{length(mesh.normals[i] - right)});
  }
  return largest;
}

/// Returns the mean cosine between shading and geometric normals over the middles of the triangles;
/// 1: flat.
double flatness(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const SurfacePoint p = mesh.surface_point(i, 0.3f, 0.3f);
    sum += dot(p.shading.n, p.normal);
  }
  return sum / static_cast<double>(mesh.triangles.size());
}

/// Returns the diagonal of a cube around the origin at its corner `p`.
Vec3 diagonal(Point3 p) {
  return {std::copysign(1.0f, p.x), std::copysign(1.0f, p.y), std::copysign(1.0f, p.z)};
}

const std::string kCubeCorners =
    "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n";
constexpr int kCubeFaces[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5},
                                  {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};

/// Returns a cube as OBJ. Bit i of `diagonals` selects how face i is cut into triangles.
std::string cube_obj(unsigned diagonals = 0) {
  std::string text = kCubeCorners;
  for (unsigned i = 0; i < 6; ++i) {
    text += "f";
    for (unsigned k = 0; k < 4; ++k) {
      text += fmt::format(" {}", kCubeFaces[i][(k + (diagonals >> i & 1)) % 4]);
    }
    text += "\n";
  }
  return text;
}

/// Returns the unit sphere in `rings` rows of twice as many quads around z. The quads at the poles
/// have two corners in the same place, so half of each is a triangle without area.
std::string sphere_obj(int rings) {
  const int columns = 2 * rings;
  std::string vertices = "v 0 0 1\nv 0 0 -1\n", faces;
  const auto name = [&](int row, int column) {
    if (row == 0 || row == rings) return row == 0 ? 1 : 2;
    return 3 + (row - 1) * columns + column % columns;
  };
  for (int row = 0; row < rings; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double polar = row * std::numbers::pi / rings;
      const double azimuth = column * std::numbers::pi / rings;
      if (row > 0) {
        vertices += fmt::format("v {} {} {}\n", std::sin(polar) * std::cos(azimuth),
                                std::sin(polar) * std::sin(azimuth), std::cos(polar));
      }
      faces += fmt::format("f {} {} {} {}\n", name(row, column), name(row + 1, column),
                           name(row + 1, column + 1), name(row, column + 1));
    }
  }
  return vertices + faces;
}

}  // namespace

TEST_CASE("smooth normals of a sphere are nearly exact") {
  const TriangleMesh sphere = loaded("sphere.obj", sphere_obj(32));
  CHECK(sphere.positions.size() == 2 + 31 * 64);
  const double error = largest_error(sphere, [](Point3 p) { return Vec3(p); });
  CHECK(error < 0.002);  // half a row is 0.05
}

TEST_CASE("smooth normals of a cube are its diagonals, however its faces are cut") {
  for (unsigned diagonals = 0; diagonals < 64; ++diagonals) {
    const TriangleMesh cube = loaded("cube.obj", cube_obj(diagonals));
    CHECK(cube.positions.size() == 8);
    CHECK(largest_error(cube, diagonal) < 1e-6);
  }
}

TEST_CASE("angles are measured where the mesh stands, and the outer side is kept") {
  for (const float x : {1.0f, -1.0f}) {
    for (const bool flip : {false, true}) {
      const TriangleMesh cube = loaded(
          "cube.obj", cube_obj(), {.to_world = Transform::scale({x, 1, 3}), .flip_normals = flip});
      const auto expected = [&](Point3 p) { return flip ? -diagonal(p) : diagonal(p); };
      CHECK(largest_error(cube, expected) < 1e-6);
    }
  }
}

TEST_CASE("the same mesh has the same bits") {
  const TriangleMesh a = loaded("a.obj", sphere_obj(16)), b = loaded("b.obj", sphere_obj(16));
  CHECK(a.normals == b.normals);
  CHECK(a.triangles == b.triangles);
}

TEST_CASE("triangles without area or thinner than rounding do not count") {
  // A floor in two halves. Vertex 5, in the middle of the edge between them, is off the floor by
  // less than a step of single precision at the far end. An upright triangle closes the gap; its
  // angle there is as large as the angles of all other triangles together.
  const TriangleMesh floor = loaded("floor.obj",
                                    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 1 1e-7\nv 1 2 0\n"
                                    "f 1 2 3 4\nf 4 5 6\nf 5 3 6\nf 4 3 5\nf 3 3 6\nf 1 4 1\n");
  CHECK(floor.positions.size() == 6);
  CHECK(largest_error(floor, [](Point3) { return Vec3{0, 0, 1}; }) < 1e-6);
}

TEST_CASE("a vertex that no triangle gives a normal has that of each of its triangles") {
  // A single triangle, thinner than rounding.
  const TriangleMesh thin = loaded("thin.obj", "v 0 0 1\nv 1 0 1\nv 0.5 0 1.0000001\nf 1 2 3\n");
  CHECK(largest_error(thin, [](Point3) { return Vec3{0, -1, 0}; }) < 1e-6);
  // Both sides of a sheet, whose normals cancel out.
  const TriangleMesh sheet =
      loaded("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 2 1\n",
             {.to_world = Transform::rotate({1, 2, 3}, 40)});
  CHECK(flatness(sheet) == doctest::Approx(1));
  // A sheet with a triangle along one edge. The normal of the triangle must not spread.
  const TriangleMesh flag = loaded(
      "flag.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 4 3 2 1\nf 1 4 5\n");
  for (std::size_t i = 0; i < flag.positions.size(); ++i) {
    if (flag.positions[i].x == 1) CHECK(std::abs(flag.normals[i].z) == 1);
  }
  CHECK(flag.positions.size() == 7);
}

TEST_CASE("normals of the file stay, those it lacks are added") {
  const TriangleMesh mesh = loaded(
      "half.obj", cube_obj() + "vn 0 0.6 0.8\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 9//1 10//1 11//1\n");
  CHECK(mesh.positions.size() == 11);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const bool has_own = mesh.positions[i].x > 1;
    const Vec3 expected = has_own ? Vec3{0, 0.6f, 0.8f} : normalize(diagonal(mesh.positions[i]));
    CHECK(length(mesh.normals[i] - expected) < 1e-6f);
  }
}

TEST_CASE("vertices that the file has twice keep an edge, also where the texture has a seam") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  CHECK(flatness(loaded("fold.obj", points + "f 1 2 3\nf 1 4 2\n")) < 0.95);
  CHECK(flatness(loaded("edge.obj", points + "v 0 0 0\nv 1 0 0\nf 1 2 3\nf 5 4 6\n")) ==
        doctest::Approx(1));
  const std::string textured = points + "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n";
  CHECK(flatness(loaded("whole.obj", textured + "f 1/1 2/2 3/3\nf 1/1 4/4 2/2\n")) < 0.95);
  CHECK(flatness(loaded("seam.obj", textured + "f 1/1 2/2 3/3\nf 1/3 4/4 2/1\n")) ==
        doctest::Approx(1));
  // Two entries with the same numbers are also two vertices.
  CHECK(
      flatness(loaded("same.obj", textured + "v 0 0 0\nv 1 0 0\nf 1/1 2/2 3/3\nf 5/1 4/4 6/2\n")) ==
      doctest::Approx(1));
}

TEST_CASE("triangles of STL files are smoothed where they agree") {
  const TriangleMesh obj = loaded("cube.obj", cube_obj());
  std::string stl = "solid\n";
  for (const auto& triangle : obj.triangles) {
    stl += "facet normal 0 0 0 outer loop\n";
    for (const std::uint32_t vertex : triangle) {
      const Point3 p = obj.positions[vertex];
      stl += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
    }
    stl += "endloop endfacet\n";
  }
  const TriangleMesh cube = loaded("cube.stl", stl + "endsolid\n");
  CHECK(cube.positions.size() == 8);
  CHECK(largest_error(cube, diagonal) < 1e-6);
}

TEST_CASE("glTF: triangles that name few of many vertices share them") {
  // Two triangles at a right angle, without normals, in a list of nine vertices.
  std::string bytes = test::bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  bytes += test::bytes_of(std::vector<float>(15, 7.0f));
  bytes += test::bytes_of<std::uint32_t>({0, 1, 2, 0, 3, 1});
  const std::string json =
      R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"indices": 1, "attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 9},
                    {"bufferView": 1, "type": "SCALAR", "componentType": 5125, "count": 6}],
      "bufferViews": [{"buffer": 0, "byteLength": 108},
                      {"buffer": 0, "byteOffset": 108, "byteLength": 24}],
      "buffers": [{"byteLength": 132}]})";
  const TriangleMesh fold = loaded("fold.glb", test::glb(json, bytes));
  CHECK(fold.positions.size() == 4);
  CHECK(flatness(fold) < 0.95);
}

}  // namespace pharos
