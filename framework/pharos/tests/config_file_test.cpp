#include <string>

#include <doctest/doctest.h>

#include <pharos/config/node.h>

#include "fixtures.h"

using namespace pharos;

namespace {

std::string config_error(const test::TemporaryFolder& folder, std::string_view name) {
  return test::input_error_in(folder, [&] { read_config(folder / name); });
}

std::string overridden(const std::string& yaml, const std::string& assignment) {
  ConfigNode root = parse_yaml(yaml, "a.yaml");
  apply_override(root, assignment);
  return to_flow_yaml(root);
}

std::string override_error(const std::string& yaml, const std::string& assignment) {
  return test::input_error([&] { overridden(yaml, assignment); });
}

}  // namespace

TEST_CASE("extends: mappings merge, everything else replaces") {
  const test::TemporaryFolder folder;
  folder.write("base.yaml",
               "film: {width: 1, filter: {type: box, radius: 2}}\nlist: [1, 2]\nseed: 3\n");
  folder.write("a.yaml",
               "extends: base.yaml\nfilm: {height: 5, filter: {radius: 4}}\nlist: [9]\nx: y\n");
  CHECK(to_flow_yaml(read_config(folder / "a.yaml")) ==
        "{ film: { width: 1, filter: { type: box, radius: 4 }, height: 5 }, list: [9], seed: 3, "
        "x: y }");
}

TEST_CASE("extends: another type replaces, the same type and no type merge, null takes back") {
  const test::TemporaryFolder folder;
  folder.write("base.yaml", "s: {type: a, k: 1}\n");
  const auto merged = [&](const std::string& own) {
    folder.write("a.yaml", "extends: base.yaml\n" + own);
    return to_flow_yaml(read_config(folder / "a.yaml"));
  };
  CHECK(merged("s: {type: b, m: 2}") == "{ s: { type: b, m: 2 } }");
  CHECK(merged("s: {type: a, m: 2}") == "{ s: { type: a, k: 1, m: 2 } }");
  CHECK(merged("s: {m: 2}") == "{ s: { type: a, k: 1, m: 2 } }");
  CHECK(merged("s: c") == "{ s: c }");
  CHECK(merged("s: ~") == "{ s: null }");
}

TEST_CASE("extends: lists, chains and folders; values keep the file they came from") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  folder.write("root.yaml", "a: 1\nb: 1\nc: 1\nd: 1\n");
  folder.write("sub/x.yaml", "extends: ../root.yaml\nb: 2\nc: 2\n");
  folder.write("y.yaml", "c: 3\n");
  folder.write("main.yaml", "extends: [sub/x.yaml, y.yaml]\nd: 4\n");
  const ConfigNode root = read_config(folder / "main.yaml");
  CHECK(to_flow_yaml(root) == "{ a: 1, b: 2, c: 3, d: 4 }");
  CHECK(root.find("a")->where().file == (folder / "root.yaml").string());
  CHECK(root.find("b")->where().file == (folder / "sub/x.yaml").string());
  CHECK(root.find("d")->where().to_string() == (folder / "main.yaml").string() + ":2:4");
}

TEST_CASE("extends: errors") {
  const test::TemporaryFolder folder;
  folder.write("a.yaml", "x: 1\nextends: b.yaml\n");
  folder.write("b.yaml", "extends: [c.yaml]\n");
  folder.write("c.yaml", "extends: ./b.yaml\n");
  CHECK(config_error(folder, "a.yaml") ==
        "c.yaml:1:1: error: 'extends' goes in a circle: 'b.yaml' extends 'c.yaml' extends "
        "'b.yaml'");
  folder.write("self.yaml", "extends: self.yaml\n");
  CHECK(config_error(folder, "self.yaml") ==
        "self.yaml:1:1: error: 'extends' goes in a circle: 'self.yaml' extends 'self.yaml'");
  folder.write("lost.yaml", "x: 1\nextends: bb.yaml\n");
  CHECK(config_error(folder, "lost.yaml") ==
        "lost.yaml:2:10: error: 'bb.yaml': no such file (did you mean 'b.yaml'?)");
  folder.write("odd.yaml", "extends: {a: b}\n");
  CHECK(config_error(folder, "odd.yaml") ==
        "odd.yaml:1:10: error: expected the path of a config or a list of paths, found the "
        "mapping { a: b }");
  folder.write("list.yaml", "- a\n");
  CHECK(config_error(folder, "list.yaml") ==
        "list.yaml:1:1: error: expected a mapping, found the list [a]");
  folder.write("d0.yaml", "x: 1\n");
  for (int i = 1; i < 30; ++i) {
    const std::string last = "d" + std::to_string(i - 1) + ".yaml";
    folder.write("d" + std::to_string(i) + ".yaml", "extends: [" + last + ", " + last + "]\n");
  }
  CHECK(config_error(folder, "d29.yaml").find("error: more than 256 files by 'extends'") !=
        std::string::npos);
}

TEST_CASE("overrides set, add and replace") {
  CHECK(overridden("a: {b: 1}", "a.b=2") == "{ a: { b: 2 } }");
  CHECK(overridden("a: {b: 1}", "a.c.d=[1, x]") == "{ a: { b: 1, c: { d: [1, x] } } }");
  CHECK(overridden("a: [{b: 1}, {b: 2}]", "a.1.b=3") == "{ a: [{ b: 1 }, { b: 3 }] }");
  CHECK(overridden("a: {b: 1}", "a={type: c, k: 2}") == "{ a: { type: c, k: 2 } }");
  CHECK(overridden("a: 1", "b=x=y") == "{ a: 1, b: \"x=y\" }");
  CHECK(overridden("a: 1", "a=") == "{ a: null }");
  CHECK(overridden("a: ~", "a.b=1") == "{ a: { b: 1 } }");
}

TEST_CASE("overrides are located on the command line") {
  ConfigNode root = parse_yaml("a: {b: 1}", "a.yaml");
  apply_override(root, "a.c.d={e: f}");
  CHECK(root.find("a")->find("c")->where().to_string() == "--set a.c.d={e: f}");
  CHECK(root.find("a")->find("c")->find("d")->find("e")->where().to_string() ==
        "--set a.c.d={e: f}");
  CHECK(root.find("a")->where_key("c").to_string() == "--set a.c.d={e: f}");
}

TEST_CASE("overrides: errors") {
  const std::string wanted = "expected KEY=VALUE with a key such as 'film.width'";
  for (const char* wrong : {"", "a", "=1", ".a=1", "a.=1", "a..b=1"}) {
    CHECK(override_error("a: 1", wrong) == std::string("--set ") + wrong + ": error: " + wanted);
  }
  CHECK(override_error("a: {b: x}", "a.b.c=1") ==
        "--set a.b.c=1: error: cannot set 'c' inside of 'a.b', which is the scalar 'x'");
  CHECK(override_error("a: [1, 2]", "a.2=1") ==
        "--set a.2=1: error: expected the index of one of the 2 items of 'a', counted from 0, "
        "found '2'");
  CHECK(override_error("a: [1, 2]", "a.-1=1") ==
        "--set a.-1=1: error: expected the index of one of the 2 items of 'a', counted from 0, "
        "found '-1'");
  CHECK(override_error("a: 1", "a=[1").find("--set a=[1: error: YAML: ") == 0);
  CHECK(override_error("a: 1", "a={b: 1, b: 2}") ==
        "--set a={b: 1, b: 2}: error: duplicate key 'b'");
}
