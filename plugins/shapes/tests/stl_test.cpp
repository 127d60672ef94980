#include <algorithm>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../stl_file.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

TriangleMesh read(const std::string& bytes) {
  return read_stl({"a.stl", bytes, ""});
}

std::string refusal(const std::string& bytes) {
  return test::input_error([&] { read(bytes); });
}

const std::string kFacet =
    "facet normal nan 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1.5 0 0\n  vertex 0 1e-3 0\n"
    " endloop\nendfacet\n";

std::string binary_triangle(float x) {
  return test::bytes_of<float>({0, 0, -1, 0, 0, 0, x, 0, 0, 0, 1e-3f, 0}) + "..";
}

/// Returns a binary file that begins with `text`.
std::string binary(const std::string& text, std::size_t count, const std::string& triangles) {
  std::string bytes = text;
  bytes.resize(80);
  return bytes + test::little_endian(count) + triangles;
}

TEST_CASE("STL: text and binary files say the same, and the order of vertices counts") {
  const std::vector<Point3> expected{{0, 0, 0}, {1.5f, 0, 0}, {0, 1e-3f, 0}};
  for (const std::string& bytes :
       {"solid a b\n" + kFacet + "endsolid a b\n", "\r\n solid " + ("\n" + kFacet) + "endsolid",
        binary("by hand", 1, binary_triangle(1.5f)), binary("solid", 1, binary_triangle(1.5f)),
        binary("", 1, binary_triangle(1.5f) + "more")}) {
    const TriangleMesh mesh = read(bytes);
    CHECK(mesh.positions == expected);
    CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    CHECK(mesh.normals.empty());
  }
}

TEST_CASE("STL: a text may hold several solids, a facet stand on one line or on many") {
  const std::string line =
      "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
  CHECK(read("solid\n" + line + line + "endsolid x\nsolid facet\n" + line + "endsolid")
            .triangles.size() == 3);
  std::string column = line;
  std::replace(column.begin(), column.end(), ' ', '\n');
  CHECK(read("solid\n" + column + "endsolid").positions ==
        std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(read("solid nothing\nendsolid\n").triangles.empty());
}

TEST_CASE("STL: what is damaged is refused with its line or triangle") {
  CHECK(refusal("") == "it is too short for an STL file");
  CHECK(refusal("mesh") == "it is too short for an STL file");
  CHECK(refusal(binary("", 4'294'967'295, binary_triangle(1))) ==
        "it ends before its 4294967295 triangles");
  CHECK(refusal(binary("", 2, binary_triangle(1) + binary_triangle(1).substr(1))) ==
        "it ends before its 2 triangles");
  CHECK(refusal(binary("", 2, binary_triangle(1) + binary_triangle(kInfinity))) ==
        "a vertex of triangle 1 is not finite");
  CHECK(refusal("solid") == "a.stl:1:6: error: the file ends where 'facet' should follow");
  CHECK(refusal("solid a\n" + kFacet) ==
        "a.stl:9:1: error: the file ends where 'facet' should follow");
  CHECK(refusal("solid a\nvertex 0 0 0\n") == "a.stl:2:1: error: expected 'facet', found 'vertex'");
  CHECK(refusal("solid a\nendsolid\nfacet\n") ==
        "a.stl:3:1: error: expected 'solid', found 'facet'");
  CHECK(refusal("solid a\n" + test::with(kFacet, "1.5 0 0", "1.5 0")) ==
        "a.stl:6:3: error: 'vertex' is not a number");
  CHECK(refusal("solid a\nfacet normal 0 0 1 outer loop vertex 0 0\n") ==
        "a.stl:3:1: error: a number is missing");
  CHECK(refusal("solid a\n" + test::with(kFacet, "1.5", "1.5.1")) ==
        "a.stl:5:10: error: '1.5.1' is not a number");
  CHECK(refusal("solid a\n" + test::with(kFacet, "1.5", "inf")) ==
        "a.stl:5:10: error: 'inf' is not finite");
  CHECK(refusal("solid a\n" + test::with(kFacet, " endloop", "  vertex 1 1 1\n endloop")) ==
        "a.stl:7:3: error: expected 'endloop', found 'vertex'");
}

}  // namespace
}  // namespace pharos
