#include <cmath>
#include <limits>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/binary_stream.h>

namespace pharos {

TEST_CASE("saved numbers come back to the bit") {
  std::stringstream file;
  save_heading(file, "thing", 3);
  save_number(file, 0.1);
  save_number(file, -0.0f);
  save_number(file, std::numeric_limits<std::uint64_t>::max());
  expect_heading(file, "thing", 3);
  CHECK(load_number<double>(file) == 0.1);
  CHECK(std::signbit(load_number<float>(file)));
  CHECK(load_number<std::uint64_t>(file) == std::numeric_limits<std::uint64_t>::max());
}

TEST_CASE("another heading is refused") {
  const auto file = [] {
    std::stringstream out;
    save_heading(out, "thing", 3);
    return out;
  };
  for (const auto& [name, version] : {std::pair{"thing", 4u}, {"thong", 3u}, {"thin", 3u}}) {
    std::stringstream in = file();
    CHECK_THROWS_AS(expect_heading(in, name, version), InputError);
  }
  std::stringstream empty;
  CHECK_THROWS_WITH_AS(expect_heading(empty, "thing", 3), "this is no saved 'thing' of version 3",
                       InputError);
}

TEST_CASE("a number that is cut off is refused") {
  std::stringstream file("abc");
  CHECK_THROWS_AS(load_number<std::uint32_t>(file), InputError);
}

TEST_CASE("NaN and infinity are refused where a number must be finite") {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double value : {1e300, kInfinite, -kInfinite, std::nan("")}) {
    std::stringstream file;
    save_number(file, value);
    if (value == 1e300) {
      CHECK(load_finite<double>(file) == value);
    } else {
      CHECK_THROWS_AS(load_finite<double>(file), InputError);
    }
  }
}

}  // namespace pharos
