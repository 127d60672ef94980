#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/config/registry.h>

#include "fixtures.h"

using namespace pharos;

namespace {

enum class Mode { one, all };

struct Inner {
  float size = 2;
  int count = 3;

  static void describe(Schema<Inner>& s) {
    s.field("size", &Inner::size, "Size").unit("m").above(0);
    s.field("count", &Inner::count, "How many").at_least(1).at_most(9);
  }
};

struct Settings {
  float radius = 0.1f;
  double precise = 0.1;
  int count = 4;
  std::uint8_t small = 7;
  bool flag = true;
  std::string name = "no: name";
  std::string title;
  std::filesystem::path file;
  Vec2 uv{0.5f, 1};
  Vec3 axis{0, 0, 1};
  Rgb color{0.5f};
  Mode mode = Mode::all;
  std::optional<float> limit;
  std::optional<int> bounces = 5;
  float bound = kInfinity;
  std::vector<int> list{1, 2};
  std::vector<Inner> parts;
  Inner inner{.size = 5};
  Transform placement = Transform::translate({1, 2, 3});

  static void describe(Schema<Settings>& s);
};

}  // namespace

namespace pharos {
template <>
struct EnumNames<Mode> {
  static constexpr auto names =
      std::to_array<EnumName<Mode>>({{"one", Mode::one}, {"all", Mode::all}});
};
}  // namespace pharos

namespace {

void Settings::describe(Schema<Settings>& s) {
  s.field("radius", &Settings::radius, "Radius").unit("m").above(0).at_most(0.3);
  s.field("precise", &Settings::precise, "A double");
  s.field("count", &Settings::count, "Count").at_least(0);
  s.field("small", &Settings::small, "A byte");
  s.field("flag", &Settings::flag, "Flag");
  s.field("name", &Settings::name, "Name");
  s.field("title", &Settings::title, "Title");
  s.field("file", &Settings::file, "File");
  s.field("uv", &Settings::uv, "Point");
  s.field("axis", &Settings::axis, "Axis");
  s.field("color", &Settings::color, "Color").at_least(0).at_most(1);
  s.field("mode", &Settings::mode, "Mode");
  s.field("limit", &Settings::limit, "Limit").above(1);
  s.field("bounces", &Settings::bounces, "Bounces");
  s.field("bound", &Settings::bound, "Clamp").at_least(0);
  s.field("list", &Settings::list, "List").at_least(0);
  s.field("parts", &Settings::parts, "Parts");
  s.field("inner", &Settings::inner, "Inner");
  s.field("placement", &Settings::placement, "Placement");
}

struct Needy {
  float value = 0;
  static void describe(Schema<Needy>& s) {
    s.field("value", &Needy::value, "What is needed").required();
  }
};

template <class T>
struct Read {
  T value;
  ConfigNode resolved;
};

template <class T>
Read<T> read(const ConfigNode& node) {
  const Registry registry;
  BuildContext context{registry};
  Read<T> result;
  result.value = Value<T>::read(node, context, result.resolved);
  return result;
}

Settings settings(const std::string& yaml) {
  return read<Settings>(parse_yaml(yaml, "a.yaml")).value;
}
template <class T = Settings>
std::string error(const std::string& yaml) {
  return test::input_error([&] { read<T>(parse_yaml(yaml, "a.yaml")); });
}

const std::string kLong = "1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6";

}  // namespace

TEST_CASE("defaults are those of the initializers, whatever their type") {
  const Settings s = settings("{}");
  CHECK(s.radius == 0.1f);
  CHECK(s.precise == 0.1);
  CHECK(s.name == "no: name");
  CHECK(s.title.empty());
  CHECK(s.file.empty());
  CHECK(s.color == Rgb(0.5f));
  CHECK(s.mode == Mode::all);
  CHECK_FALSE(s.limit);
  CHECK(s.bounces == 5);
  CHECK(s.bound == kInfinity);
  CHECK(s.list == std::vector<int>{1, 2});
  CHECK(s.parts.empty());
  CHECK(s.inner.size == 5);
  CHECK(s.inner.count == 3);
  CHECK(s.placement.point({0, 0, 0}) == Vec3{1, 2, 3});
}

TEST_CASE("every type is read") {
  const Settings s = settings(
      "radius: .25\nprecise: 1e-3\ncount: 0x10\nsmall: 255\nflag: false\nname: 12\nuv: [1, -2]\n"
      "axis: [+1, 2., 3e0]\ncolor: [0, 0.5, 1]\nmode: one\nlimit: 2\nbounces: ~\nlist: []\n"
      "parts: [{size: 1}, {count: 9}]\ninner: {count: 1}\n");
  CHECK(s.radius == 0.25f);
  CHECK(s.precise == 1e-3);
  CHECK(s.count == 16);
  CHECK(s.small == 255);
  CHECK_FALSE(s.flag);
  CHECK(s.name == "12");
  CHECK(s.uv == Vec2{1, -2});
  CHECK(s.axis == Vec3{1, 2, 3});
  CHECK(s.color == Rgb(0, 0.5f, 1));
  CHECK(s.mode == Mode::one);
  CHECK(s.limit == 2.0f);
  CHECK_FALSE(s.bounces);
  CHECK(s.list.empty());
  REQUIRE(s.parts.size() == 2);
  CHECK(s.parts[0].size == 1);
  CHECK(s.parts[1].count == 9);
  CHECK(s.inner.size == 2);
  CHECK(s.inner.count == 1);
}

TEST_CASE("the resolved config states all values in force and reads back as the same") {
  for (const std::string yaml :
       {"{}",
        "{radius: 0.3, bounces: null, color: [0.1, 0.2, 0.3], name: 'null', mode: one, "
        "limit: 1.7, parts: [{size: 0.7}], file: x.exr, title: '~', list: [3], "
        "placement: [{rotate: {axis: [1, 2, 3], degrees: 40}}, {scale: 3}]}"}) {
    const auto first = read<Settings>(parse_yaml(yaml, "/folder/a.yaml"));
    const auto second = read<Settings>(parse_yaml(to_yaml(first.resolved), "/elsewhere/b.yaml"));
    CHECK(to_yaml(first.resolved) == to_yaml(second.resolved));
    CHECK(first.value.placement.inverse_point({1, 2, 3}) ==
          second.value.placement.inverse_point({1, 2, 3}));
    CHECK(first.value.color == second.value.color);
    CHECK(first.value.bounces == second.value.bounces);
    CHECK(first.value.file == second.value.file);
  }
  CHECK(to_yaml(read<Settings>(parse_yaml("{}", "a.yaml")).resolved) ==
        "radius: 0.1\nprecise: 0.1\ncount: 4\nsmall: 7\nflag: true\nname: \"no: name\"\n"
        "title: \"\"\nuv: [0.5, 1]\naxis: [0, 0, 1]\ncolor: 0.5\nmode: all\nbounces: 5\n"
        "list: [1, 2]\nparts: []\ninner:\n  size: 5\n  count: 3\n"
        "placement:\n  matrix: [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3]\n");
}

TEST_CASE("what a schema tells about its parameters") {
  Schema<Settings> schema;
  Settings::describe(schema);
  const std::vector<ParameterInfo> all = schema.parameters();
  REQUIRE(all.size() == 19);
  CHECK(all[0].key == "radius");
  CHECK(all[0].type == "number");
  CHECK(all[0].unit == "m");
  CHECK(all[0].default_value == "0.1");
  CHECK(all[0].range == "> 0 and <= 0.3");
  CHECK(all[0].help == "Radius");
  CHECK_FALSE(all[0].required);
  CHECK(all[11].type == "choice");
  CHECK(all[11].range == "one | all");
  CHECK(all[11].choices == std::vector<std::string>{"one", "all"});
  CHECK(all[0].choices.empty());
  CHECK(all[12].default_value.empty());
  CHECK(all[14].default_value.empty());
  CHECK(all[15].type == "list of integer");
  CHECK(all[15].default_value == "[1, 2]");
  CHECK(all[17].default_value == "{ size: 5 }");
  Schema<Needy> needy;
  Needy::describe(needy);
  CHECK(needy.parameters()[0].required);
  CHECK(needy.parameters()[0].default_value.empty());
}

TEST_CASE("errors: keys") {
  CHECK(error<Inner>("size: 1\nsise: 2\n") ==
        "a.yaml:2:1: error: unknown key 'sise' (did you mean 'size'?); known keys: 'size', "
        "'count'");
  CHECK(error<Inner>("type: x") ==
        "a.yaml:1:1: error: unknown key 'type'; known keys: 'size', 'count'");
  CHECK(error<Inner>("[1]") ==
        "a.yaml:1:1: error: expected a mapping with keys from 'size', 'count', found the list "
        "[1]");
  CHECK(error<Needy>("{}") ==
        "a.yaml:1:1: error: the required key 'value' is missing (number: What is needed)");
  CHECK(error<Needy>("value: ~") == "a.yaml:1:8: error: expected a number, found nothing");
  CHECK(error<NoSettings>("x: 1") == "a.yaml:1:1: error: unknown key 'x'; known keys: none");
}

TEST_CASE("errors: ranges") {
  CHECK(error("radius: -1") == "a.yaml:1:9: error: radius must be > 0, got -1");
  CHECK(error("radius: 0") == "a.yaml:1:9: error: radius must be > 0, got 0");
  CHECK(error("radius: 0.30001") == "a.yaml:1:9: error: radius must be <= 0.3, got 0.30001");
  CHECK(error("radius: 0.3") == "no error");
  CHECK(error("count: -1") == "a.yaml:1:8: error: count must be >= 0, got -1");
  CHECK(error("color: [0, 2, 0]") == "a.yaml:1:8: error: color must be <= 1, got [0, 2, 0]");
  CHECK(error("limit: 1") == "a.yaml:1:8: error: limit must be > 1, got 1");
  CHECK(error("list: [1, -2]") == "a.yaml:1:7: error: list must be >= 0, got [1, -2]");
  CHECK(error("inner:\n  count: 10") == "a.yaml:2:10: error: count must be <= 9, got 10");
  CHECK(error("parts:\n  - size: 1\n  - size: 0") == "a.yaml:3:11: error: size must be > 0, got 0");
}

TEST_CASE("errors: numbers") {
  const auto number = [](const std::string& text) { return error("precise: " + text); };
  CHECK(number("{a: b}") == "a.yaml:1:10: error: expected a number, found the mapping { a: b }");
  CHECK(number("~") == "a.yaml:1:10: error: expected a number, found nothing");
  for (const std::string junk : {"x", "1x", "1,5", "1e", "--1", "+-1", "1.2.3", "0x", "0x1g",
                                 "-0x1", "0x-1", "1 2", ".", "e5", "1_000"}) {
    CHECK(number("'" + junk + "'") ==
          "a.yaml:1:10: error: expected a number, found the scalar '" + junk + "'");
  }
  for (const std::string endless : {".inf", "-.inf", ".nan", "inf", "NaN", "Infinity"}) {
    CHECK(number(endless) ==
          "a.yaml:1:10: error: expected a finite number, found the scalar '" + endless + "'");
  }
  CHECK(number("1e999") ==
        "a.yaml:1:10: error: expected a number of magnitude up to 1.798e+308, found the scalar "
        "'1e999'");
  CHECK(error("radius: 1e39") ==
        "a.yaml:1:9: error: expected a number of magnitude up to 3.403e+38, found the scalar "
        "'1e39'");
  CHECK(error("count: 1e3") == "a.yaml:1:8: error: expected an integer, found the scalar '1e3'");
  CHECK(error("count: 2.0") == "a.yaml:1:8: error: expected an integer, found the scalar '2.0'");
  CHECK(error("count: ''") == "a.yaml:1:8: error: expected an integer, found the scalar ''");
  CHECK(error("count: 3000000000") ==
        "a.yaml:1:8: error: expected an integer from -2147483648 to 2147483647, found the scalar "
        "'3000000000'");
  CHECK(error("small: -1") ==
        "a.yaml:1:8: error: expected an integer from 0 to 255, found the scalar '-1'");
  CHECK(error("small: 99999999999999999999") ==
        "a.yaml:1:8: error: expected an integer from 0 to 255, found the scalar "
        "'99999999999999999999'");
}

TEST_CASE("errors: other types") {
  CHECK(error("flag: yes") == "a.yaml:1:7: error: expected true or false, found the scalar 'yes'");
  CHECK(error("name: [a]") == "a.yaml:1:7: error: expected a string, found the list [a]");
  CHECK(error("file: ''") == "a.yaml:1:7: error: expected a path, found the scalar ''");
  CHECK(error("uv: 1") ==
        "a.yaml:1:5: error: expected a list of 2 numbers [x, y], found the scalar '1'");
  CHECK(error("axis: [1, 2]") ==
        "a.yaml:1:7: error: expected a list of 3 numbers [x, y, z], found the list [1, 2]");
  CHECK(error("axis: [1, 2, z]") == "a.yaml:1:14: error: expected a number, found the scalar 'z'");
  CHECK(error("color: red") ==
        "a.yaml:1:8: error: expected a color: a number or a list of 3 numbers [r, g, b], found "
        "the scalar 'red'");
  CHECK(error("mode: al") ==
        "a.yaml:1:7: error: expected one of 'one', 'all', found the scalar 'al' (did you mean "
        "'all'?)");
  CHECK(error("mode: [all]") ==
        "a.yaml:1:7: error: expected one of 'one', 'all', found the list [all]");
  CHECK(error("list: 3") == "a.yaml:1:7: error: expected a list of integer, found the scalar '3'");
}

TEST_CASE("paths are relative to their file, or to the working directory") {
  const auto file = [](const ConfigNode& node) { return read<std::filesystem::path>(node).value; };
  CHECK(file(ConfigNode::scalar("../x.exr", {"/a/b/c.yaml", 3, 1})) == "/a/x.exr");
  CHECK(file(ConfigNode::scalar("/y/x.exr", {"/a/b/c.yaml", 3, 1})) == "/y/x.exr");
  const auto here = std::filesystem::current_path();
  CHECK(file(ConfigNode::scalar("x.exr", {"c.yaml", 3, 1})) == here / "x.exr");
  CHECK(file(ConfigNode::scalar("d/x.exr", {"--set output.image=d/x.exr"})) == here / "d/x.exr");
}

TEST_CASE("transforms: every form, and steps in their order") {
  const auto at = [](const std::string& yaml, Vec3 p) {
    return read<Transform>(parse_yaml(yaml, "a.yaml")).value.point(p);
  };
  CHECK(at("[]", {1, 2, 3}) == Vec3{1, 2, 3});
  CHECK(at("{translate: [1, 2, 3]}", {0, 0, 0}) == Vec3{1, 2, 3});
  CHECK(at("{scale: 2}", {1, 2, 3}) == Vec3{2, 4, 6});
  CHECK(at("{scale: [1, 2, 3]}", {1, 1, 1}) == Vec3{1, 2, 3});
  CHECK(at("{rotate: {axis: [0, 0, 1], degrees: 90}}", {1, 0, 0}) == Vec3{0, 1, 0});
  CHECK(at("{look_at: {origin: [0, 0, 5], target: [0, 0, 0]}}", {0, 0, 1}) == Vec3{0, 0, 4});
  CHECK(at("{matrix: [" + kLong + "]}", {0, 0, 0}) == Vec3{4, 5, 6});
  CHECK(at("{matrix: [" + kLong + ", 0, 0, 0, 1]}", {0, 0, 0}) == Vec3{4, 5, 6});
  CHECK(at("[{scale: 2}, {translate: [1, 0, 0]}]", {1, 0, 0}) == Vec3{3, 0, 0});
}

TEST_CASE("transforms: errors") {
  CHECK(error<Transform>("{tranlate: [1, 2, 3]}") ==
        "a.yaml:1:2: error: expected one of 'translate', 'scale', 'rotate', 'look_at', 'matrix', "
        "found the scalar 'tranlate' (did you mean 'translate'?)");
  const std::string step =
      "expected one step such as { translate: [x, y, z] } or a list of such steps, found ";
  CHECK(error<Transform>("{scale: 2, translate: [1, 2, 3]}") ==
        "a.yaml:1:1: error: " + step + "the mapping { scale: 2, translate: [1, 2, 3] }");
  CHECK(error<Transform>("3") == "a.yaml:1:1: error: " + step + "the scalar '3'");
  CHECK(error<Transform>("[{scale: 1},\n {scale: [1, 0, 1]}]") ==
        "a.yaml:2:2: error: the transform cannot be inverted");
  CHECK(error<Transform>("{rotate: {axis: [0, 0, 1]}}") ==
        "a.yaml:1:10: error: the required key 'degrees' is missing (number: Angle, "
        "counter-clockwise)");
  CHECK(error<Transform>("{look_at: {origin: [0, 0, 0], target: [0, 1, 0]}}") ==
        "a.yaml:1:1: error: look_at: up is parallel to the direction from origin to target");
  CHECK(error<Transform>("{matrix: [1, 2]}") ==
        "a.yaml:1:10: error: expected a list of 12 or 16 numbers, row by row, found the list [1, "
        "2]");
  CHECK(error<Transform>("{matrix: [" + kLong + ", 0, 0, 0, 2]}") ==
        "a.yaml:1:10: error: the last row of a 4x4 matrix must be 0, 0, 0, 1");
}

TEST_CASE("number texts are the shortest that read back") {
  CHECK(number_text(0.1f) == "0.1");
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(100000.0f) == "100000");
  CHECK(number_text(1.0f) == "1");
  CHECK(number_text(kInfinity).empty());
  CHECK(number_text(static_cast<double>(NAN)).empty());
  CHECK(is_number(number_text(1e-30f)));
}
