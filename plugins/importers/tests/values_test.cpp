// Every spelling of plain values and transforms.

#include <array>
#include <cmath>
#include <string>

#include "document_test_kit.h"

namespace pharos::mitsuba {
namespace {

std::string tag(const std::string& name, const std::string& attributes) {
  return "<" + name + " name=\"v\" " + attributes + "/>";
}

template <class T>
T read(const std::string& name, const std::string& attributes) {
  CAPTURE(attributes);
  return value<T>(*read_new(tag(name, attributes)).scene, "v");
}

Transform read_steps(const std::string& steps, bool old = false) {
  const std::string text = "<transform name=\"v\">" + steps + "</transform>";
  return value<Transform>(*(old ? read_old(text) : read_new(text)).scene, "v");
}

bool is_near(Vec3 a, Vec3 b) {
  return length(a - b) < 1e-5f;
}

TEST_CASE("booleans, integers, numbers, strings") {
  CHECK(read<bool>("boolean", "value=\"true\""));
  CHECK_FALSE(read<bool>("boolean", "value=\"False\""));
  CHECK(read<std::int64_t>("integer", "value=\" -12 \"") == -12);
  CHECK(read<std::int64_t>("integer", "value=\"+9223372036854775807\"") == 9223372036854775807);
  CHECK(read<double>("float", "value=\"-1.5e-3\"") == -0.0015);
  CHECK(read<double>("float", "value=\" +.5 \"") == 0.5);
  CHECK(read<double>("float", "value=\"2.\"") == 2);
  CHECK(read<double>("float", "value=\"1e-999\"") == 0);
  CHECK(read<std::string>("string", "value=\"a/b &lt;c&gt; \xc3\xa4\"") == "a/b <c> \xc3\xa4");
  CHECK(read<std::string>("string", "value=\"\"").empty());
}

TEST_CASE("points and vectors") {
  CHECK(read<Triple>("point", "x=\"1\" y=\"-2\" z=\"3e1\"").value == Vec3{1, -2, 30});
  CHECK(read<Triple>("vector", "value=\"1 2 3\"").value == Vec3{1, 2, 3});
  CHECK(read<Triple>("vector", "value=\"1, 2,3\"").value == Vec3{1, 2, 3});
  CHECK(read<Triple>("point", "value=\"4\"").value == Vec3{4, 4, 4});
}

TEST_CASE("steps of transforms") {
  const Vec3 p{1, 2, 3};
  CHECK(read_steps("").point(p) == p);
  CHECK(read_steps("<translate x=\"1\" z=\"2\"/>").point(p) == Vec3{2, 2, 5});
  CHECK(read_steps("<translate value=\"1, 0, 2\"/>").point(p) == Vec3{2, 2, 5});
  CHECK(read_steps("<scale value=\"2\"/>").point(p) == Vec3{2, 4, 6});
  CHECK(read_steps("<scale value=\"2 3 4\"/>").point(p) == Vec3{2, 6, 12});
  CHECK(read_steps("<scale y=\"3\"/>").point(p) == Vec3{1, 6, 3});
  CHECK(is_near(read_steps("<rotate z=\"1\" angle=\"90\"/>").point(p), {-2, 1, 3}));
  CHECK(is_near(read_steps("<rotate value=\"0 0 2\" angle=\"90\"/>").point(p), {-2, 1, 3}));
  const std::string rows = "0 -1 0 5, 1 0 0 6, 0 0 1 7, 0 0 0 1";
  CHECK(read_steps("<matrix value=\"" + rows + "\"/>").point(p) == Vec3{3, 7, 10});
  CHECK(read_steps("<matrix value=\"0 -1 0 1 0 0 0 0 1\"/>").point(p) == Vec3{-2, 1, 3});
}

TEST_CASE("the first step is applied first") {
  const Transform t = read_steps("<scale value=\"2\"/><translate x=\"1\"/>");
  CHECK(t.point({1, 1, 1}) == Vec3{3, 2, 2});
  const Transform u = read_steps("<translate x=\"1\"/><scale value=\"2\"/>");
  CHECK(u.point({1, 1, 1}) == Vec3{4, 2, 2});
}

TEST_CASE("lookat, with and without up") {
  for (const std::string name : {"lookat", "lookAt"}) {
    const Transform t =
        read_steps("<" + name + " origin=\"1 2 3\" target=\"1, 2, 8\" up=\"0 1 0\"/>");
    CHECK(is_near(t.point({0, 0, 2}), {1, 2, 5}));
    CHECK(is_near(t.vector({0, 1, 0}), {0, 1, 0}));
    CHECK(is_near(t.vector({1, 0, 0}), {1, 0, 0}));
  }
  // Each dialect has its own rule for a view along z without `up`.
  const std::string bare = "<lookat origin=\"0 0 0\" target=\"0 0 4\"/>";
  CHECK(is_near(read_steps(bare, true).vector({0, 1, 0}), {1, 0, 0}));
  CHECK(is_near(read_steps(bare).vector({0, 1, 0}), {1, 0, 0}));
  const std::string tilted = "<lookat origin=\"0 0 0\" target=\"3 0 4\" up=\"0 0 0\"/>";
  CHECK(is_near(read_steps(tilted, true).vector({0, 1, 0}), {0, -1, 0}));
  CHECK(is_near(read_steps(tilted).vector({0, 1, 0}), {0.8f, 0, -0.6f}));
  const std::string skew = "<lookat origin=\"0 0 0\" target=\"2 1 2\"/>";
  CHECK_FALSE(
      is_near(read_steps(skew, true).vector({0, 1, 0}), read_steps(skew).vector({0, 1, 0})));
}

TEST_CASE("an animation stands still at its earliest time") {
  const Document d = read_old(
      "<shape type=\"instance\"><animation name=\"toWorld\">"
      "<transform time=\"1\"><translate x=\"5\"/></transform>"
      "<transform time=\"0.5\"><translate x=\"2\"/></transform></animation></shape>");
  CHECK(value<Transform>(child(*d.scene), "to_world").point({0, 0, 0}) == Vec3{2, 0, 0});
  REQUIRE(d.notes.size() == 1);
  CHECK(d.notes[0].where.column == 47);
}

}  // namespace
}  // namespace pharos::mitsuba
