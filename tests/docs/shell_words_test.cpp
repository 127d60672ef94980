// Commands as a shell reads them.

#include "shell_words.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace pharos::docs {
namespace {

using Words = std::vector<std::string>;

TEST_CASE("words: quotes, comments, lines that go on") {
  const auto commands = shell_commands(
      "./run render a.yaml \\\n    --set 'b={ c: 1 }'   # a comment; not a command\n"
      "\n./run pharos points --sampler '{ type: x,\n  d: 30 }' -n 64\n# nothing\necho \"a b\"c\\ "
      "d\n");
  REQUIRE(commands.size() == 3);
  CHECK(commands[0].words == Words{"./run", "render", "a.yaml", "--set", "b={ c: 1 }"});
  CHECK(commands[0].line == 0);
  CHECK(commands[1].words ==
        Words{"./run", "pharos", "points", "--sampler", "{ type: x,\n  d: 30 }", "-n", "64"});
  CHECK(commands[1].line == 3);
  CHECK(commands[2].words == Words{"echo", "a bc d"});
  CHECK(commands[2].line == 6);
}

TEST_CASE("words: several commands on a line, redirections") {
  const auto commands = shell_commands("a b && c; d | e\nf g > h.txt i\nj#k 'l");
  REQUIRE(commands.size() == 6);
  CHECK(commands[0].words == Words{"a", "b"});
  CHECK(commands[3].words == Words{"e"});
  CHECK(commands[4].words == Words{"f", "g", "i"});
  CHECK(commands[5].words == Words{"j#k", "l"});
}

TEST_CASE("quoted words are read back") {
  const std::string word = "it's { a: \"b\" } \\ $x";
  const auto commands = shell_commands("echo " + quoted("plain words"));
  CHECK(commands.at(0).words == Words{"echo", "plain words"});
  CHECK(quoted("it's") == "'it'\\''s'");
  CHECK(shell_commands(quoted(word)).at(0).words == Words{word});
}

}  // namespace
}  // namespace pharos::docs
