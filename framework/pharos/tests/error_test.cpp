#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "fixtures.h"

using namespace pharos;

TEST_CASE("a location leaves out what is unknown") {
  CHECK(Location{"a.yaml", 3, 7}.to_string() == "a.yaml:3:7");
  CHECK(Location{"a.yaml", 3, 0}.to_string() == "a.yaml:3");
  CHECK(Location{"a.yaml"}.to_string() == "a.yaml");
  CHECK(Location{"", 3, 7}.to_string() == "line 3:7");
  CHECK(Location{}.to_string().empty());
}

TEST_CASE("an input error knows whether it says where") {
  const InputError located({"a.yaml", 3, 7}, "wrong");
  CHECK(std::string(located.what()) == "a.yaml:3:7: error: wrong");
  CHECK(located.located());
  const InputError unlocated("wrong");
  CHECK(std::string(unlocated.what()) == "wrong");
  CHECK_FALSE(unlocated.located());
  const InputError nowhere(Location{}, "wrong");
  CHECK(std::string(nowhere.what()) == "wrong");
  CHECK_FALSE(nowhere.located());
}

TEST_CASE("an input error keeps its place") {
  const InputError located({"a.yaml", 3, 7}, "wrong");
  CHECK(located.where().file == "a.yaml");
  CHECK(located.where().line == 3);
  CHECK(located.where().column == 7);
  CHECK(InputError("wrong").where().to_string().empty());
}

TEST_CASE("errors of independent parts are collected, equal ones once") {
  InputErrorList errors;
  CHECK_NOTHROW(errors.raise());
  CHECK(errors.attempt([] {}));
  CHECK_NOTHROW(errors.raise());
  CHECK_FALSE(errors.attempt([] { throw InputError({"a.yaml", 1}, "first"); }));
  CHECK_THROWS_AS(errors.raise(), InputError);
  errors.add(InputError({"a.yaml", 2}, "second"));
  errors.add(InputError({"a.yaml", 1}, "first"));
  InputErrorList outer;  // takes the errors one by one
  outer.attempt([&] { errors.raise(); });
  outer.attempt([&] { errors.raise(); });
  try {
    outer.raise();
    FAIL("nothing was thrown");
  } catch (const InputErrors& all) {
    REQUIRE(all.all().size() == 2);
    CHECK(std::string(all.all()[0].what()) == "a.yaml:1: error: first");
    CHECK(std::string(all.all()[1].what()) == "a.yaml:2: error: second");
    CHECK(std::string(all.what()) == all.all()[0].what());
    CHECK(all.where().line == 1);
  }
}

TEST_CASE("only errors of the input are collected") {
  InputErrorList errors;
  CHECK_THROWS_AS(errors.attempt([] { throw RunError("disk full"); }), RunError);
}

TEST_CASE("suggestions") {
  const std::vector<std::string> known{"radius", "height", "radian", "x", "emission"};
  SUBCASE("one edit of each kind") {
    for (const char* wrong : {"raduis", "radiu", "radiuss", "radiua", "Radius"}) {
      CHECK(suggestion(wrong, known) == " (did you mean 'radius'?)");
    }
  }
  SUBCASE("a third of the letters may differ") {
    CHECK(suggestion("emisin", known) == " (did you mean 'emission'?)");  // 2 of 6
    CHECK(suggestion("emsin", known).empty());                            // 3 of 5
  }
  SUBCASE("of names equally near the first is taken") {
    CHECK(suggestion("radius", std::vector<std::string>{"radiuc", "radiua"}) ==
          " (did you mean 'radiuc'?)");
    CHECK(suggestion("radias", known) == " (did you mean 'radius'?)");
  }
  SUBCASE("a name without a common letter is never near") {
    CHECK(suggestion("y", known).empty());
    CHECK(suggestion("", known).empty());
    CHECK(suggestion("y", {}).empty());
  }
}

TEST_CASE("a missing file's nearest name is sought in its folder") {
  const test::TemporaryFolder folder;
  folder.write("kitchen.yaml", "");
  folder.write("attic.yaml", "");
  CHECK(file_suggestion(folder / "kichen.yaml") == " (did you mean 'kitchen.yaml'?)");
  CHECK(file_suggestion(folder / "garden.yaml").empty());
  CHECK(file_suggestion(folder / "none/kitchen.yaml").empty());
}

TEST_CASE("one_line keeps messages on one line and whole characters") {
  CHECK(one_line("a\nb\tc\x01\n") == "a b c?");
  CHECK(one_line("abcdef", 3) == "abc…");
  CHECK(one_line("abcdef", 6) == "abcdef");
  CHECK(one_line("aää", 2) == "a…");
}

TEST_CASE("messages are one line whatever they quote") {
  CHECK(std::string(InputError({"a\nb", 1, 2}, "no '\x1b[1m\n'").what()) ==
        "a b:1:2: error: no '?[1m '");
  CHECK(std::string(RunError("a\r\nb").what()) == "a  b");
}

TEST_CASE("what cannot be read as a file, and why") {
  const test::TemporaryFolder folder;
  folder.write("scene.yaml", "");
  CHECK(file_problem(folder / "scene.yaml").empty());
  CHECK(file_problem(folder / "scen.yaml") == "no such file (did you mean 'scene.yaml'?)");
  CHECK(file_problem(folder.path()) == "expected a file, found a folder");
  CHECK(file_problem("/dev/null") == "expected a file, found a pipe or device");
  CHECK(file_problem(std::string(5000, 'x')).find("the file cannot be reached: ") == 0);
}

TEST_CASE("quoted lists") {
  CHECK(quoted_list(std::vector<std::string>{"a", "b"}) == "'a', 'b'");
  CHECK(quoted_list({}) == "none");
}
