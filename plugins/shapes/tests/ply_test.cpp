#include <algorithm>
#include <cstring>
#include <limits>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../mesh.h"
#include "../ply_file.h"
#include "../weld.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

const std::string kVertexHeader = "property float x\nproperty float y\nproperty float z\n";

std::string header(const std::string& format, const std::string& vertices,
                   const std::string& faces) {
  return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex " + vertices + "\n" +
         kVertexHeader + "element face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string kTriangle = "0 0 0\n1 0 0\n0 1 0\n";

std::string refusal(const std::string& text) {
  return test::input_error([&] { read_ply(text); });
}

/// Appends a number in the byte order of the file.
template <class T>
void append(std::string& text, T value, bool big_endian) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big_endian) std::reverse(std::begin(bytes), std::end(bytes));
  text.append(bytes, sizeof(T));
}

TEST_CASE("PLY: all properties that count are found among others, polygons become fans") {
  const TriangleMesh mesh = read_ply(
      "ply\r\nformat ascii 1.0\r\nobj_info from a test\r\n"
      "element face 2\nproperty uchar flags\nproperty list uchar uint vertex_index\n"
      "element edge 1\nproperty list uchar float weights\n"
      "element vertex 4\nproperty uchar red\nproperty double z\nproperty float y\n"
      "property float32 x\nproperty list uchar short more\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property float t\nproperty float s\nend_header\n"
      "7 4 0 1 2 3\n7 2 0 1\n2 0.5 0.5\n"
      "255 9 0 0 0 0 0 1 0 0\n255 9 0 1 2 5 5 0 0 1 0 1\n"
      "255 9 1 1 0 0 0 1 1 1\n255 9 1 0 0 0 0 1 1 0\n");
  REQUIRE(mesh.triangles.size() == 2);
  CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});
  CHECK(mesh.positions[2] == Point3{1, 1, 9});
  CHECK(mesh.normals[3] == Vec3{0, 0, 1});
  CHECK(mesh.uvs[1] == Vec2{1, 0});
  CHECK(mesh.uvs[3] == Vec2{0, 1});
}

TEST_CASE("PLY: binary files of either byte order hold the same") {
  for (const bool big : {false, true}) {
    std::string text = "ply\nformat " +
                       std::string(big ? "binary_big_endian" : "binary_little_endian") +
                       " 1.0\nelement vertex 3\nproperty double x\nproperty short y\n"
                       "property float z\nelement face 1\n"
                       "property list ushort uint vertex_indices\nend_header\n";
    for (const Point3 p : {Point3{1, 2, 3}, Point3{-4, -5, -6}, Point3{0.25f, 300, 1e-3f}}) {
      append(text, double{p.x}, big);
      append(text, static_cast<std::int16_t>(p.y), big);
      append(text, p.z, big);
    }
    append(text, std::uint16_t{3}, big);
    for (const std::uint32_t i : {2u, 1u, 0u}) append(text, i, big);
    const TriangleMesh mesh = read_ply(text);
    CHECK(mesh.positions[1] == Point3{-4, -5, -6});
    CHECK(mesh.positions[2] == Point3{0.25f, 300, 1e-3f});
    CHECK(mesh.triangles[0] == std::array<std::uint32_t, 3>{2, 1, 0});
    for (std::size_t cut = 1; cut < 55; ++cut) {
      CHECK(refusal(text.substr(0, text.size() - cut)) != "no error");
    }
  }
}

TEST_CASE("PLY: what is damaged is refused, naming the vertex or face") {
  CHECK(refusal("") == "it ends within the header");
  CHECK(refusal("plyx\n") == "it does not begin with a line 'ply'");
  CHECK(refusal("ply\nformat ascii 1.0\n") == "it ends within the header");
  CHECK(refusal("ply\nend_header\n") == "its header names no format");
  CHECK(refusal("ply\nformat yaml 1.0\nend_header\n") ==
        "line 2 of its header, 'format yaml 1.0', names no known format");
  CHECK(refusal(header("ascii", "-3", "1")) ==
        "line 4 of its header, 'element vertex -3', has no valid count");
  CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 3\nproperty real x\nend_header\n") ==
        "line 4 of its header, 'property real x', names no known type");
  CHECK(refusal("ply\nformat ascii 1.0\nvertices 3\nend_header\n") ==
        "line 3 of its header, 'vertices 3', is unknown");
  CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n") ==
        "its vertices lack x, y or z");

  CHECK(refusal("ply\nformat ascii 1.0\nproperty float x\n") ==
        "line 3 of its header, 'property float x', belongs to no element");

  const std::string whole = header("ascii", "3", "1");
  CHECK(refusal(whole + kTriangle) == "face 0 is cut off or not made of numbers");
  CHECK(refusal(whole + kTriangle + "3 0 1") == "face 0 is cut off or not made of numbers");
  CHECK(refusal(whole + kTriangle + "200 0 1 2\n") ==
        "face 0 has a list that is longer than the file");
  CHECK(refusal(whole + "0 0 0\n1 0 zero\n") == "vertex 1 is cut off or not made of numbers");
  CHECK(refusal(whole + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n") == "vertex 1 is not finite");
  CHECK(refusal(whole + "0 0 0\n1 0 0\n0 1e99 0\n3 0 1 2\n") == "vertex 2 is not finite");
  CHECK(refusal(whole + kTriangle + "3 0 1 3\n") == "a face names vertex 3, which is missing");
  CHECK(refusal(whole + kTriangle + "3 0 1 -2\n") == "face 0 names vertex -2, which is missing");
  for (const char* format : {"ascii", "binary_little_endian"}) {
    CHECK(refusal(header(format, "4000000000", "1") + kTriangle) ==
          "it ends before its 4000000000 elements 'vertex'");
  }
}

TEST_CASE("PLY: an element comes once, so that every vertex has the same properties") {
  const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
  const std::string begin = "ply\nformat ascii 1.0\nelement vertex 1\n" + kVertexHeader;
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  CHECK(refusal(begin + normals + "element vertex 2\n" + kVertexHeader + faces +
                "end_header\n0 0 0 0 0 1\n1 0 0\n0 1 0\n3 0 1 2\n") ==
        "line 10 of its header, 'element vertex 2', names an element for the second time");
  CHECK(refusal(begin + faces + faces + "end_header\n0 0 0\n3 0 0 0\n3 0 0 0\n") ==
        "line 9 of its header, 'element face 1', names an element for the second time");
}

TEST_CASE("PLY: a property comes once, and the format has version 1.0") {
  CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 1\n" + kVertexHeader +
                "property float x\nend_header\n0 0 0 0\n") ==
        "line 7 of its header, 'property float x', names a property for the second time");
  CHECK(refusal("ply\nformat ascii 2.0\nend_header\n") ==
        "line 2 of its header, 'format ascii 2.0', names no known version: known is 1.0");
}

TEST_CASE("PLY: counts are believed no further than the bytes reach") {
  // Rows without properties take no bytes, so a loop over the rows would not end.
  const std::string empty = "element nothing 18446744073709551615\n";
  const TriangleMesh mesh =
      read_ply(test::with(header("ascii", "3", "1"), "element face", empty + "element face") +
               kTriangle + "3 0 1 2\n");
  CHECK(mesh.triangles.size() == 1);
  CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 9\nend_header\n" + kTriangle) ==
        "its vertices lack x, y or z");
  CHECK(refusal(header("ascii", "9", "1") + kTriangle) == "it ends before its 9 elements 'vertex'");
  CHECK(refusal(header("ascii", "6148914691236517206", "1") + kTriangle) ==
        "it ends before its 6148914691236517206 elements 'vertex'");

  std::string many =
      test::with(header("binary_little_endian", "0", "1"), "uchar int", "uint uchar");
  append(many, std::uint32_t{200'000'003}, false);
  many.resize(many.size() + 200'000'003);
  CHECK(refusal(many) == "it would have 200000001 triangles; at most 200000000 are possible");
}

TEST_CASE("PLY: numbers too small for a float are 0") {
  const TriangleMesh mesh =
      read_ply(header("ascii", "3", "1") + "1e-400 -1e-60 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK(mesh.positions[0] == Point3{0, 0, 0});
}

TEST_CASE("PLY: a mesh names the file, has no parts, and needs triangles") {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& text, const std::string& part) {
    return test::input_error_in(folder,
                                [&] { Mesh({.file = folder.write("a.PLY", text), .part = part}); });
  };
  const std::string whole = header("ascii", "3", "1") + kTriangle + "3 0 1 2\n";
  CHECK(message(whole, "") == "no error");
  CHECK(message(whole, "lid") == "mesh 'a.PLY': .ply files have no parts");
  CHECK(message(whole.substr(0, whole.size() - 3), "") ==
        "mesh 'a.PLY': face 0 is cut off or not made of numbers");
  CHECK(message(header("ascii", "3", "0") + kTriangle, "") ==
        "mesh 'a.PLY': it holds no triangles");
  CHECK(message(header("ascii", "0", "0"), "") == "mesh 'a.PLY': it holds no triangles");
}

TEST_CASE(
    "welding joins vertices that agree in every bit and leaves out those that nothing names") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {0, 0.5f}, {1, 1}};
  mesh.triangles = {{0, 1, 2}, {5, 4, 6}};
  const TriangleMesh joined = welded(mesh);
  CHECK(joined.positions.size() == 5);
  CHECK(joined.bounds().high == Point3{1, 1, 0});
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t before = mesh.triangles[i][k], after = joined.triangles[i][k];
      CHECK(joined.positions[after] == mesh.positions[before]);
      CHECK(joined.uvs[after] == mesh.uvs[before]);
    }
  }
  CHECK(joined.triangles[0][1] == joined.triangles[1][1]);
  CHECK(joined.triangles[0][2] != joined.triangles[1][0]);  // a seam of the texture
}

TEST_CASE(
    "welding tells zeros apart by their sign, joins NaN, and refuses lists of other lengths") {
  // As numbers all of these compare equal.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  TriangleMesh mesh;
  for (int i = 0; i < 64; ++i) {
    mesh.positions.push_back({i & 1 ? -0.0f : 0.0f, i & 2 ? -0.0f : 0.0f, i & 4 ? -0.0f : 0.0f});
    mesh.normals.push_back({i & 8 ? -0.0f : 0.0f, i & 16 ? -0.0f : 0.0f, i & 32 ? -0.0f : 0.0f});
    const auto k = static_cast<std::uint32_t>(i);
    mesh.triangles.push_back({k, k, k});
  }
  CHECK(welded(mesh).positions.size() == 64);
  for (Vec3& n : mesh.normals) n = {nan, nan, nan};
  CHECK(welded(mesh).positions.size() == 8);

  const std::string differ = "its vertices, normals and texture coordinates differ in number";
  mesh.normals.pop_back();
  CHECK(test::input_error([&] { welded(mesh); }) == differ);
  mesh.normals.clear();
  mesh.uvs.resize(65);
  CHECK(test::input_error([&] { welded(mesh); }) == differ);
}

}  // namespace
}  // namespace pharos
