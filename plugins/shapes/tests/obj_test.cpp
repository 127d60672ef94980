#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../obj_file.h"

namespace pharos {
namespace {

TriangleMesh read(const std::string& text, const std::string& part = "") {
  return read_obj({"a.obj", text, part});
}

std::string refusal(const std::string& text, const std::string& part = "") {
  return test::input_error([&] { read(text, part); });
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Returns the first vertex of each triangle.
std::vector<Point3> first_corners(const TriangleMesh& mesh) {
  std::vector<Point3> corners;
  for (const auto& triangle : mesh.triangles) corners.push_back(mesh.positions[triangle[0]]);
  return corners;
}

TEST_CASE("OBJ: polygons become fans, and their corners may be counted from the last one back") {
  using Corners = std::array<std::uint32_t, 3>;
  const std::vector<Corners> fan{{0, 1, 2}, {0, 2, 3}};
  CHECK(read(kSquare + "f 1 2 3 4\n").triangles == fan);
  CHECK(read(kSquare + "f -4 -3 -2 -1\nv 9 9 9").triangles == fan);
  CHECK(read(kSquare + "f 1 2\nf 3\nf\n").triangles.empty());  // no surface
}

TEST_CASE("OBJ: corners name positions, texture coordinates and normals, or leave them out") {
  const TriangleMesh mesh = read(kSquare +
                                 "vt 0.5\nvt 0.25 0.75 0\nvn 0 0 1\nvn 1 0 0\n"
                                 "f 1/1/1 2/2/2 3/-1\nf 1//1 2//-1 4\nf 1/ 2// 3\n");
  REQUIRE(mesh.triangles.size() == 3);
  CHECK(mesh.uvs ==
        std::vector<Vec2>{{0.5f, 0}, {0.25f, 0.75f}, {0.25f, 0.75f}, {}, {}, {}, {}, {}, {}});
  CHECK(mesh.normals ==
        std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}, {}, {0, 0, 1}, {1, 0, 0}, {}, {}, {}, {}});
  CHECK(mesh.positions[5] == Point3{0, 1, 0});
  CHECK(read(kSquare + "vn 0 0 1\nvt 0 0\nf 1 2 3\n").normals.empty());
}

TEST_CASE("OBJ: comments, continued lines, blanks and what says nothing of surfaces") {
  const TriangleMesh mesh = read(
      "\xef\xbb\xbf# by hand\r\n\r\nmtllib nowhere.mtl\r\n  v\t+1e0 0 0 1.0 # weight\r\n"
      "v 0 1 0 0.5 0.5 0.5\r\nv 0 0 \\\r\n 1\r\nusemtl gold\r\ns off\r\nl 1 2 \\\r\n3\r\np 1\r\n"
      "f 1 2\\\r\n 3 #4\r\n");
  REQUIRE(mesh.triangles.size() == 1);
  CHECK(mesh.positions == std::vector<Point3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

TEST_CASE("OBJ: a statement ends with its last continued line, though what is there is not used") {
  const TriangleMesh mesh = read(
      "v 1 2 3 \\\n1.0\nv 0 1 0 \\\r\n\\\r\n0.5 0.5 0.5\nvt 0.5 0.5 \\\n0\n"
      "vn 0 0 1 \\\n # weight \\\nv 1e-400 -1e-60 1\nf 1/1/1 2/1/1 3/1/1\n");
  CHECK(mesh.positions == std::vector<Point3>{{1, 2, 3}, {0, 1, 0}, {0, 0, 1}});
  CHECK(refusal(std::string("v 0\0 0 0\n", 9)).find("a.obj:1:3: error: '0?' is not a number") == 0);
  CHECK(refusal("v 0 0 0 \\\n1\nv 0 0\n") == "a.obj:3:6: error: a number is missing");
}

TEST_CASE("OBJ: objects and groups are parts, and positions are counted through the file") {
  const std::string text = kSquare +
                           "f 1 2 3\n"
                           "o the table # 1\nf 2 3 4\ng leg wood\nf 3 4 1\n"
                           "o chair\nv 5 5 5\nf 5 1 2\ng wood\nf 4 1 2\ng empty\n";
  CHECK(read(text).triangles.size() == 5);
  CHECK(first_corners(read(text, "the table # 1")) == std::vector<Point3>{{1, 0, 0}, {1, 1, 0}});
  CHECK(first_corners(read(text, "leg")) == std::vector<Point3>{{1, 1, 0}});
  CHECK(first_corners(read(text, "wood")) == std::vector<Point3>{{1, 1, 0}, {0, 1, 0}});
  CHECK(first_corners(read(text, "chair")) == std::vector<Point3>{{5, 5, 5}, {0, 1, 0}});
  CHECK(refusal(text, "empty") ==
        "it has no part 'empty'; its parts are 'chair', 'leg', 'the table # 1', 'wood'");
  CHECK(refusal(text, "chiar") ==
        "it has no part 'chiar' (did you mean 'chair'?); its parts are 'chair', 'leg', "
        "'the table # 1', 'wood'");
  CHECK(refusal(kSquare + "f 1 2 3\n", "lid") == "it has no part 'lid'; its parts are none");
}

TEST_CASE("OBJ: what is damaged is refused at its line and column") {
  CHECK(refusal("this is not a mesh") ==
        "a.obj:1:1: error: 'this' is no statement that can be read");
  CHECK(refusal("v 0 0 0\ncurv2 1 2\n") ==
        "a.obj:2:1: error: 'curv2' is no statement that can be read");
  CHECK(refusal("v 0 0\n") == "a.obj:1:6: error: a number is missing");
  CHECK(refusal("v 0 0 \\\n\n") == "a.obj:2:1: error: a number is missing");
  CHECK(refusal("v 0 zero 0\n") == "a.obj:1:5: error: 'zero' is not a number");
  CHECK(refusal("v 0 1,5 0\n") == "a.obj:1:5: error: '1,5' is not a number");
  CHECK(refusal("v 0 0 nan\n") == "a.obj:1:7: error: 'nan' is not finite");
  CHECK(refusal("v 0 0 0\nvn -inf 0 0\n") == "a.obj:2:4: error: '-inf' is not finite");
  CHECK(refusal("vt 1e39 0\n") == "a.obj:1:4: error: '1e39' is not finite");
  CHECK(refusal("v 1e999 0 0\n") == "a.obj:1:3: error: '1e999' is not finite");
  CHECK(refusal(kSquare + "f 1 2 5\n") ==
        "a.obj:5:7: error: there is no vertex 5; it is preceded by 4");
  CHECK(refusal(kSquare + "f 0 1 2\n") ==
        "a.obj:5:3: error: there is no vertex 0; it is preceded by 4");
  CHECK(refusal(kSquare + "f 1 2 -5\n") ==
        "a.obj:5:7: error: there is no vertex -5; it is preceded by 4");
  CHECK(refusal(kSquare + "f 1 2/1 3\n") ==
        "a.obj:5:5: error: there is no texture coordinate 1; it is preceded by 0");
  CHECK(refusal(kSquare + "vn 0 0 1\nf 1 2//2 3\n") ==
        "a.obj:6:5: error: there is no normal 2; it is preceded by 1");
  CHECK(refusal(kSquare + "f 1 2 three\n") == "a.obj:5:7: error: 'three' is not a whole number");
  CHECK(refusal(kSquare + "f 1 2 1.5\n") == "a.obj:5:7: error: '1.5' is not a whole number");
  CHECK(refusal(kSquare + "f 1 2 99999999999999999999\n") ==
        "a.obj:5:7: error: '99999999999999999999' is not a whole number");
  CHECK(refusal(kSquare + "f 1 2 /1\n") ==
        "a.obj:5:7: error: there is no texture coordinate 1; it is preceded by 0");
  CHECK(refusal(kSquare + "f 1 2 /\n") == "a.obj:5:7: error: '/' is no corner of a face");
  CHECK(refusal(kSquare + "f 1 2 3/1/1/1\n").starts_with("a.obj:5:7: error: "));
  CHECK(refusal(kSquare + "vn 0 0 1\nvt 0 0\nf 1 2 3/1/1/1\n") ==
        "a.obj:7:7: error: '3/1/1/1' is no corner of a face");
}

}  // namespace
}  // namespace pharos
