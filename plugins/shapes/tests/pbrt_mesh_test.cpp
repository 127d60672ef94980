// Meshes within scene files of pbrt.

#include "../pbrt_mesh.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

TriangleMesh read(const std::string& text, const std::string& part) {
  return read_pbrt_mesh({"a.pbrt", text, part});
}

std::string refusal(const std::string& text, const std::string& part = "1:1") {
  return test::input_error([&] { read(text, part); });
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST_CASE("pbrt meshes: a trianglemesh with all that it may have") {
  const std::string text =
      "# \"Shape\"\n  Shape \"trianglemesh\" \"float alpha\" 1 # two triangles\n"
      "\"point P\" [ 0 0 0  1 0 0\n 1 1.5 0  0 1 0 ] \"integer indices\" [ 0 1 2 0 2 3 ]\n"
      "\"normal N\" [ 0 0 1 0 0 1 0 0 1 0 0 1 ] \"point2 uv\" [ 0 0 1 0 1 1 0 1 ]\nShape "
      "\"sphere\"";
  const TriangleMesh mesh = read(text, "2:3");
  CHECK(mesh.positions == std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {1, 1.5f, 0}, {0, 1, 0}});
  CHECK(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.normals == std::vector<Vec3>(4, {0, 0, 1}));
  CHECK(mesh.uvs == std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

TEST_CASE("pbrt meshes: one triangle needs no indices") {
  const TriangleMesh mesh =
      read("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]", "1:1");
  CHECK(mesh.triangles == Triangles{{0, 1, 2}});
  CHECK(mesh.normals.empty());
  CHECK(mesh.uvs.empty());
}

TEST_CASE("pbrt meshes: normals decide on the outer side, as in pbrt") {
  const TriangleMesh mesh = read(
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"normal N\" [ 0 0 -1 0 0 -1 0 0 "
      "-1 ]",
      "1:1");
  CHECK(mesh.triangles == Triangles{{0, 2, 1}});
}

TEST_CASE("pbrt meshes: patches are two triangles, with coordinates of their own") {
  const TriangleMesh mesh =
      read("Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]", "1:1");
  CHECK(mesh.triangles == Triangles{{0, 1, 3}, {0, 3, 2}});
  CHECK(mesh.uvs == std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  const TriangleMesh two = read(
      "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 2 0 0 2 1 0 ] \"integer "
      "indices\" [ 0 1 2 3 1 4 3 5 ]",
      "1:1");
  CHECK(two.triangles.size() == 4);
  CHECK(two.positions.size() == 8);
  CHECK(two.uvs.size() == 8);
}

TEST_CASE("pbrt meshes: the control mesh of a subdivision surface") {
  const TriangleMesh mesh = read(
      "Shape \"loopsubdiv\" \"integer levels\" 3 \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer "
      "indices\" [ 0 1 2 ]",
      "1:1");
  CHECK(mesh.triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("pbrt meshes: wrong parts and wrong meshes") {
  const std::string good = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]";
  for (const char* part : {"", "1", "1:", "1:x", ":1", "0:1", "1:1:1", "a:1"}) {
    CAPTURE(part);
    CHECK(refusal(good, part).starts_with("the part of a .pbrt file is the line and column"));
  }
  CHECK(refusal(good, "2:1") == "a.pbrt:2:1: error: there is no Shape here");
  CHECK(refusal(good, "1:7") == "a.pbrt:1:7: error: there is no Shape here");
  CHECK(refusal(good, "1:99") == "a.pbrt:1:99: error: there is no Shape here");
  CHECK(refusal("Shape \"sphere\"") == "a.pbrt:1:1: error: the shape 'sphere' has no triangles");
  CHECK(refusal("Shape \"trianglemesh\"") == "a.pbrt:1:1: error: 'P' is missing");
  const std::string mesh = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] ";
  CHECK(refusal(mesh) == "a.pbrt:1:1: error: 'indices' is missing");
  CHECK(refusal(mesh + "\"integer indices\" [ 0 1 2 3 ]") ==
        "a.pbrt:1:61: error: 'indices' has 4 numbers, not a multiple of 3");
  CHECK(refusal(mesh + "\"integer indices\" [ 0 1 4 ]") ==
        "a.pbrt:1:61: error: the index 4 is out of range: there are 4 vertices");
  CHECK(refusal(mesh + "\"integer indices\" [ 0 1 -1 ]") ==
        "a.pbrt:1:61: error: the index -1 is out of range: there are 4 vertices");
  CHECK(refusal(mesh + "\"float indices\" [ 0 1 2 ]") ==
        "a.pbrt:1:61: error: 'indices' must be of type integer, found float");
  CHECK(refusal(mesh + "\"integer indices\" [ 0 1 2 ] \"normal N\" [ 0 0 1 ]") ==
        "a.pbrt:1:89: error: 'N' has 1 values for 4 vertices");
}

}  // namespace
}  // namespace pharos
