// Texts that are not a config: broken YAML, wrong encodings, expansion bombs.

#include <doctest/doctest.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

using std::string;

TEST_CASE("broken YAML") {
  check_refused("scene: [1, 2\n", {"bad.yaml:", "YAML: "});
  check_refused("scene: { sensor: perspective\nbudget: 3\n", {"bad.yaml:", "YAML: "});
  check_refused("scene: 'no end\n", {"bad.yaml:", "YAML: "});
  check_refused("scene: x\n\tbudget: 1\n", {"bad.yaml:2:1: error: ", "YAML: "});
  check_refused("scene: *nobody\n", {"bad.yaml:1:", "YAML: "});
  check_refused("scene: &me [*me]\n", {"bad.yaml:1:13: error: ", "alias"});
  check_refused("scene: !!python/object:os.system x\n", {"bad.yaml:1:8: error: ", "tags"});
  check_refused("scene: x\n---\nscene: y\n", {"bad.yaml:2:1: error: ", "second"});
  check_refused("? [a, b]\n: 1\n", {"bad.yaml:1:3: error: ", "expected a key"});
}

TEST_CASE("nothing, or no mapping") {
  check_refused("", {"bad.yaml: error: ", "empty"});
  check_refused("# only a remark\n", {"bad.yaml: error: ", "empty"});
  check_refused("just a sentence\n", {"bad.yaml:1:1: error: ", "expected a mapping"});
  check_refused("[scene, budget]\n", {"bad.yaml:1:1: error: ", "expected a mapping"});
  check_refused("null\n", {"bad.yaml:1:1: error: ", "expected a mapping"});
  check_refused("{}\n", {"bad.yaml:1:1: error: ", "'scene'"});
}

TEST_CASE("duplicate and merge keys") {
  check_refused(config_with("seed: 1\nseed: 2\n"), {"bad.yaml:6:1: error: ", "line 5"});
  check_refused(config_with("film: { width: 3, width: 4 }\n"), {"bad.yaml:5:19: error: "});
  check_refused(config_with("film: &a { width: 3 }\noutput: { <<: *a }\n"),
                {"bad.yaml:6:11: error: ", "merge keys", "extends"});
}

TEST_CASE("encodings") {
  check_refused("scene: \xff\n", {"bad.yaml:1:8: error: ", "UTF-8", "0xff"});
  check_refused("scene: \xc3(\n", {"bad.yaml:1:8: error: ", "UTF-8"});
  check_refused("scene: \xed\xa0\x80\n", {"bad.yaml:1:8: error: ", "UTF-8"});
  check_refused(string("scene: a\0b\n", 11), {"bad.yaml:1:9: error: ", "0x00"});
  check_refused(string("\xff\xfes\0c\0e\0n\0e\0", 12), {"bad.yaml:1:1: error: ", "UTF-8"});
  check_refused(
      "\x7f"
      "ELF\x02\x01",
      {"bad.yaml:1:1: error: ", "UTF-8"});
}

TEST_CASE("bombs") {
  check_refused(string(10000, '[') + "\n", {"bad.yaml:1:", "deeper than"});
  check_refused("scene: " + string(10000, '{') + "\n", {"bad.yaml:1:", "deeper than"});
  string steps = "scene:\n";
  for (int i = 0; i < 200; ++i) steps += string(static_cast<std::size_t>(i) + 1, ' ') + "a:\n";
  check_refused(steps, {"bad.yaml:", "deeper than"});
  string laughs = "a0: &a0 [ha, ha, ha, ha, ha, ha, ha, ha, ha, ha]\n";
  for (int i = 1; i < 12; ++i) {
    const string last = "*a" + std::to_string(i - 1), own = std::to_string(i);
    laughs += "a" + own + ": &a" + own + " [" + last;
    for (int k = 1; k < 10; ++k) laughs += ", " + last;
    laughs += "]\n";
  }
  check_refused(laughs, {"bad.yaml:", "nodes"});
  check_refused(config_with("seed: " + string(100000, '7') + "\n"), {"bad.yaml:5:7: error: "});
  check_refused(config_with(string(1000, 'k') + ": 1\n"), {"bad.yaml:5:1: error: ", "…"});
  check_refused(string(33 << 20, '#') + "\n", {"bad.yaml: error: ", "32 MiB"});
}

TEST_CASE("byte order marks, Windows' line ends and anchors are fine") {
  const ScratchFolder folder;
  string windows = "\xef\xbb\xbf";
  for (const char c : config_with("film: &f { width: 3 }\n"))
    windows += c == '\n' ? "\r\n" : string{c};
  folder.write("windows.yaml", windows);
  folder.write("unix.yaml", config_with("film: { width: 3 }\n"));
  const Outcome outcome = run_pharos("validate windows.yaml", folder.path());
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == run_pharos("validate unix.yaml", folder.path()).out);
}

}  // namespace
}  // namespace pharos::testing
