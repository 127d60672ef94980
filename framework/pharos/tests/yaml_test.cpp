#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/config/node.h>
#include <pharos/core/random.h>

#include "fixtures.h"

using namespace pharos;

namespace {

std::string parse_error(const std::string& text) {
  return test::input_error([&] { parse_yaml(text, "a.yaml"); });
}

bool equal(const ConfigNode& a, const ConfigNode& b) {
  if (a.kind() != b.kind() || a.text() != b.text()) return false;
  if (a.items().size() != b.items().size() || a.entries().size() != b.entries().size())
    return false;
  for (std::size_t i = 0; i < a.items().size(); ++i) {
    if (!equal(a.items()[i], b.items()[i])) return false;
  }
  for (std::size_t i = 0; i < a.entries().size(); ++i) {
    if (a.entries()[i].key != b.entries()[i].key) return false;
    if (!equal(a.entries()[i].value, b.entries()[i].value)) return false;
  }
  return true;
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

/// Returns a tree of random shape with texts for which a writer may wrongly leave out quotes.
ConfigNode random_node(RandomStream& random, int depth) {
  const auto pick = [&](std::uint64_t n) { return static_cast<int>(random() % n); };
  const auto text = [&] {
    static const std::vector<std::string> pieces{
        "a",  "b",  "0",  "1",    " ",    ".",    "-",   "+",   ":",  "#", "=", "/",
        ",",  "[",  "]",  "{",    "}",    "&",    "*",   "!",   "|",  ">", "<", "'",
        "%",  "@",  "`",  "?",    "~",    "\"",   "é",   "名",  "😀",  "_", "e", "\\",
        "\n", "\t", "\r", "\x01", "\x7f", "null", "---", "...", " #", ": "};
    std::string t;
    for (int i = pick(6); i > 0; --i) t += pieces[random() % pieces.size()];
    return t;
  };
  const int kind = pick(depth > 0 ? 5 : 2);
  if (kind == 0) return ConfigNode::null();
  if (kind <= 2) return ConfigNode::scalar(text());
  ConfigNode node = kind == 3 ? ConfigNode::sequence() : ConfigNode::mapping();
  for (int i = pick(4); i > 0; --i) {
    if (kind == 3) {
      node.items().push_back(random_node(random, depth - 1));
    } else {
      node.set(text(), random_node(random, depth - 1));
    }
  }
  return node;
}

}  // namespace

TEST_CASE("kinds, order and places") {
  const ConfigNode root = parse_yaml("b: 1\na: [x, 'y z']\nc:\n  d: ~\n  e: \"\"\n", "a.yaml");
  REQUIRE(root.is_mapping());
  REQUIRE(root.entries().size() == 3);
  CHECK(root.entries()[0].key == "b");
  CHECK(root.where().to_string() == "a.yaml:1:1");
  CHECK(root.find("b")->text() == "1");
  CHECK(root.find("b")->where().to_string() == "a.yaml:1:4");
  CHECK(root.where_key("a").to_string() == "a.yaml:2:1");
  CHECK(root.find("a")->is_sequence());
  CHECK(root.find("a")->items()[1].text() == "y z");
  CHECK(root.find("a")->items()[1].where().to_string() == "a.yaml:2:8");
  CHECK(root.find("c")->where().to_string() == "a.yaml:4:3");
  CHECK(root.find("c")->find("d")->is_null());
  CHECK(root.find("c")->find("e")->is_scalar());
  CHECK(root.find("none") == nullptr);
  CHECK(root.where_key("none").to_string() == "a.yaml:1:1");
}

TEST_CASE("quoted nulls are texts") {
  CHECK(parse_yaml("'null'", "a").is_scalar());
  CHECK(parse_yaml("\"~\"", "a").is_scalar());
  CHECK(parse_yaml("null", "a").is_null());
}

TEST_CASE("aliases are copied out and keep the place where they were written") {
  const ConfigNode root = parse_yaml("a: &x {k: 1}\nb: *x\n", "a.yaml");
  CHECK(root.find("b")->find("k")->text() == "1");
  CHECK(root.find("b")->find("k")->where().to_string() == "a.yaml:1:11");
}

TEST_CASE("a value that was left out stands where its key does") {
  const ConfigNode root = parse_yaml("a:\n\nb: null\n", "a.yaml");
  CHECK(root.find("a")->where().to_string() == "a.yaml:1:1");
  CHECK(root.find("b")->where().to_string() == "a.yaml:3:4");
}

TEST_CASE("documents that are refused") {
  CHECK(parse_error("a: 1\nb: 2\n a: 3\n").find("a.yaml:3:3: error: YAML: ") == 0);
  CHECK(parse_error("a: [1, 2\n").find("a.yaml:2:1: error: YAML: ") == 0);
  CHECK(parse_error("[1").find("a.yaml:1:1: error: YAML: ") == 0);
  CHECK(parse_error("a: 'x\nb: 2\n").find("a.yaml:3:7: error: YAML: ") == 0);
  CHECK(parse_error("a: \"x\nb: 2\n").find("a.yaml:3:6: error: YAML: ") == 0);
  CHECK(parse_error("x: 1\ny:\n  a: 1\n  b: 2\n  a: 3\n") ==
        "a.yaml:5:3: error: duplicate key 'a', first given in line 3");
  CHECK(parse_error("{a: 1, a: 2}") ==
        "a.yaml:1:8: error: duplicate key 'a', first given in line 1");
  CHECK(parse_error("[a, b]: 1\n") == "a.yaml:1:1: error: expected a key, found the list [a, b]");
  CHECK(parse_error("? {a: b}\n: 1\n") ==
        "a.yaml:1:3: error: expected a key, found the mapping { a: b }");
  CHECK(parse_error("~: 1\n") == "a.yaml:1:1: error: expected a key, found nothing");
  CHECK(parse_error("a: &k [1]\n*k : 2\n") ==
        "a.yaml:2:1: error: expected a key, found the list [1]");
  CHECK(parse_error("a: 1\n---\nb: 2\n") ==
        "a.yaml:2:1: error: expected one YAML document, found a second one");
  CHECK(parse_error("") == "a.yaml: error: expected YAML, found an empty document");
  CHECK(parse_error("# only a remark\n") ==
        "a.yaml: error: expected YAML, found an empty document");
  CHECK(parse_error("a: !!int 3") ==
        "a.yaml:1:4: error: YAML tags are not supported, found 'tag:yaml.org,2002:int'");
  CHECK(parse_error("a: !include b.yaml") ==
        "a.yaml:1:4: error: YAML tags are not supported, found '!include'");
  CHECK(parse_error("a: &x { b: 1 }\nc: { <<: *x }\n") ==
        "a.yaml:2:6: error: YAML merge keys are not supported: use 'extends'");
  CHECK(parse_error("a: *b").find("a.yaml:1:4: error: YAML: ") == 0);
  CHECK(parse_error("a: &x [*x]") ==
        "a.yaml:1:8: error: an alias may not stand inside the node that it names");
}

TEST_CASE("texts that are not UTF-8 are refused at their first bad byte") {
  CHECK(parse_error(std::string("a: b\nc: \0d", 10)) ==
        "a.yaml:2:4: error: not UTF-8 text (byte 0x00)");
  CHECK(parse_error("é: \xff") == "a.yaml:1:4: error: not UTF-8 text (byte 0xff)");
  CHECK(parse_error("a: \xc3") == "a.yaml:1:4: error: not UTF-8 text (byte 0xc3)");
  CHECK(parse_error("a: \xc0\x80") == "a.yaml:1:4: error: not UTF-8 text (byte 0xc0)");
  CHECK(parse_error("a: \xed\xa0\x80") == "a.yaml:1:4: error: not UTF-8 text (byte 0xed)");
  CHECK(parse_error("a: \x1b[0m") == "a.yaml:1:4: error: not UTF-8 text (byte 0x1b)");
  CHECK(parse_error("ä: 你好 😀\n") == "no error");
}

TEST_CASE("limits: depth, nodes, aliases that multiply") {
  CHECK(parse_error(repeated("[", 64) + repeated("]", 64)) == "no error");
  CHECK(parse_error(repeated("[", 65) + repeated("]", 65)) ==
        "a.yaml:1:65: error: nesting is deeper than 64 levels");
  CHECK(parse_error(repeated("[", 100'000)).find("deeper than 64") != std::string::npos);
  const std::string half = repeated("[", 40) + repeated("]", 40);
  CHECK(parse_error("a: &x " + half + "\nb: " + repeated("[", 30) + "*x" + repeated("]", 30)) ==
        "a.yaml:2:34: error: nesting is deeper than 64 levels");
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    bomb += repeated(", " + last, 9) + "]\n";
  }
  CHECK(parse_error(bomb).find(": error: the document has more than 1000000 nodes") !=
        std::string::npos);
  const std::string long_text = "a: &x " + std::string(1'000'000, 'x') + "\nb: [";
  CHECK(parse_error(long_text + repeated("*x, ", 200) + "*x]").find("more than 1000000 nodes") !=
        std::string::npos);
}

TEST_CASE("many keys are checked for duplicates in good time") {
  std::string text;
  for (int i = 0; i < 50'000; ++i) text += "k" + std::to_string(i) + ": 1\n";
  CHECK(parse_yaml(text, "a").entries().size() == 50'000);
  CHECK(parse_error(text + "k7: 1\n") ==
        "a.yaml:50001:1: error: duplicate key 'k7', first given in line 8");
}

TEST_CASE("files that cannot be read") {
  const test::TemporaryFolder folder;
  folder.write("base.yaml", "a: 1\n");
  folder.write("twice.yaml", "a: 1\na: 2\n");
  folder.write("empty.yaml", "");
  std::filesystem::create_directory(folder / "folder");
  const auto error = [&](std::string_view name) {
    return test::input_error_in(folder, [&] { read_yaml(folder / name); });
  };
  CHECK(error("bas.yaml") == "bas.yaml: error: no such file (did you mean 'base.yaml'?)");
  CHECK(error("scene.yaml") == "scene.yaml: error: no such file");
  CHECK(error("folder") == "folder: error: expected a file, found a folder");
  CHECK(error("twice.yaml") == "twice.yaml:2:1: error: duplicate key 'a', first given in line 1");
  CHECK(error("empty.yaml") == "empty.yaml: error: expected YAML, found an empty document");
}

TEST_CASE("YAML is written in blocks, with lists of scalars on one line") {
  const std::string text =
      "name: a b\n"
      "list: [1, -2.5, 1e-3, \"a: b\"]\n"
      "nothing: null\n"
      "empty: {}\n"
      "text: \"null\"\n"
      "none: \"\"\n"
      "shapes:\n"
      "  - type: sphere\n"
      "    center: [0, 1, 2]\n"
      "    inside:\n"
      "      type: fog\n"
      "  - - [1, 2]\n"
      "    - [3]\n"
      "  - word\n";
  CHECK(to_yaml(parse_yaml(text, "a")) == text);
  CHECK(to_flow_yaml(parse_yaml("a: {b: [1, {c: d}]}\ne: ''\n", "a")) ==
        "{ a: { b: [1, { c: d }] }, e: \"\" }");
  CHECK(to_yaml(ConfigNode::scalar("x")) == "x\n");
}

TEST_CASE("what is written reads back as the same") {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    RandomStream random(seed);
    const ConfigNode node = random_node(random, 4);
    const std::string block = to_yaml(node), flow = to_flow_yaml(node);
    CAPTURE(block);
    CHECK(equal(parse_yaml_at(block, {}), node));
    CHECK(equal(parse_yaml_at(flow, {}), node));
  }
}

TEST_CASE("descriptions are short") {
  const auto describe = [](const std::string& text) { return parse_yaml(text, "a").describe(); };
  CHECK(describe("null") == "nothing");
  CHECK(describe("x") == "the scalar 'x'");
  CHECK(describe("[1, 2]") == "the list [1, 2]");
  CHECK(describe("{type: sobol}") == "the mapping { type: sobol }");
  CHECK(describe("[" + repeated("12345678, ", 40) + "1]") ==
        "the list [12345678, 12345678, 12345678, 12345678, 12345678,…]");
}
