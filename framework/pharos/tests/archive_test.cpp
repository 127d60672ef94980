#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/archive.h>
#include <pharos/tests/fixtures.h>
#include <pharos/tests/read_only.h>

namespace pharos {
namespace {

using test::saved;

enum class Kind : std::uint8_t { one = 1, two = 2 };

/// A value of every kind that archives support.
struct Thing {
  bool flag = false;
  std::uint64_t count = 0;
  double number = 0;
  float infinite = 0;
  Kind kind = Kind::one;
  std::string text;
  Vec3 place;
  Rgb color;
  Bounds3 box;
  std::array<int, 2> pair{};
  float triple[3] = {};
  std::vector<std::vector<Vec2>> lists;
  std::optional<int> absent, present;
  std::vector<float> block;

  void archive(Archive& archive) {
    archive.heading("thing", 3);
    archive(flag, count, number, kind, text, place, color, box, pair, triple, lists, absent,
            present);
    archive.block(block);
    archive.unchecked(infinite);
    archive.expect(number != 7, "the thing");
  }
};

Thing example() {
  Thing thing{.flag = true,
              .count = std::numeric_limits<std::uint64_t>::max(),
              .number = 0.1,
              .infinite = kInfinity,
              .kind = Kind::two,
              .text = "a text",
              .place = {1, 2, -0.0f},
              .color = {0.25f, 0.5f, 0.75f},
              .pair = {3, 4},
              .triple = {5, 6, 7}};
  thing.lists = {{{1, 2}, {3, 4}}, {}, {{5, 6}}};
  return thing;
}

Thing loaded(const std::string& bytes) {
  std::istringstream in(bytes);
  Thing thing;
  load(in, thing);
  return thing;
}

}  // namespace

TEST_CASE("what is saved comes back to the bit") {
  const Thing original = example();
  const Thing copy = loaded(saved(original));
  CHECK(copy.flag);
  CHECK(copy.count == original.count);
  CHECK(copy.number == 0.1);
  CHECK(std::isinf(copy.infinite));
  CHECK(copy.kind == Kind::two);
  CHECK(copy.text == "a text");
  CHECK(copy.place == original.place);
  CHECK(std::signbit(copy.place.z));
  CHECK(copy.color == original.color);
  CHECK(copy.box.empty());
  CHECK(copy.pair == original.pair);
  CHECK(copy.triple[2] == 7);
  CHECK(copy.lists == original.lists);
  CHECK(saved(copy) == saved(original));
}

TEST_CASE("saving changes nothing, so that other threads may read what is saved") {
  CHECK(test::saved_read_only(example()) == saved(example()));
}

TEST_CASE("archives that are cut off are refused at every length") {
  const std::string whole = saved(example());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CHECK_THROWS_AS(loaded(whole.substr(0, size)), InputError);
  }
}

TEST_CASE("another heading is refused") {
  std::string bytes = saved(example());
  bytes[bytes.find("thing")] = 's';
  CHECK_THROWS_WITH_AS(loaded(bytes), "this is no saved 'thing' of version 3", InputError);
}

TEST_CASE("NaN, infinity and failed expectations are refused when loading") {
  Thing thing = example();
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    thing.number = value;
    CHECK_THROWS_AS(loaded(saved(thing)), InputError);
  }
  thing.number = 7;  // saving does not check values
  CHECK_THROWS_WITH_AS(loaded(saved(thing)), "the thing is damaged", InputError);
}

TEST_CASE("a damaged count costs no memory") {
  std::ostringstream out;
  Archive archive(out);
  std::uint64_t count = 1ull << 60;
  archive(count);
  std::istringstream in(out.str());
  std::vector<double> values;
  CHECK_THROWS_AS(load(in, values), InputError);
}

}  // namespace pharos
