// Points from a file: each set holds all of them, moved on the torus.
#include "../point_list.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "point_lists.h"

namespace pharos {
namespace {

constexpr Dimension kLight{Purpose::light_position, 2};

std::string message_of(const std::string& content) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("points.txt", content);
  return test::input_error_in(folder, [&] { read_point_list(file); });
}

/// Returns whether `p`, moved back by (x, y) on the torus, is `point`.
bool is_moved_by(double x, double y, Vec2 p, Vec2 point) {
  const auto wrapped = [](double v) { return v - std::floor(v); };
  return wrapped(p.x - x) == double{point.x} && wrapped(p.y - y) == double{point.y};
}

/// Returns whether `samples` are `points` in any order, moved by an offset they share.
bool is_moved(const std::vector<Vec2>& samples, const std::vector<Vec2>& points) {
  const Vec2 sample = samples.front();
  return std::ranges::any_of(points, [&](Vec2 first) {
    const double x = double{sample.x} - double{first.x}, y = double{sample.y} - double{first.y};
    return std::ranges::all_of(points, [&](Vec2 point) {
      return std::ranges::any_of(samples, [&](Vec2 p) { return is_moved_by(x, y, p, point); });
    });
  });
}

}  // namespace

TEST_CASE("point_list: a set holds the points of the file, moved on the torus") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("points.txt", "# x y\n0.125 0.5\n0.25\t0\n\n  0.5 0.75 \r\n");
  const std::vector<Vec2> points = read_point_list(file);
  CHECK(points == std::vector<Vec2>{{0.125f, 0.5f}, {0.25f, 0}, {0.5f, 0.75f}});
  const PointListSampler sampler({.file = file});
  CHECK(sampler.preferred_samples({}) == 3);
  const auto prepared = sampler.prepare({}, {.seed = 7}, nullptr);
  for (const std::uint64_t pixel : {0, 1, 50}) {
    for (const std::uint32_t set : {0u, 1u, 9u}) {
      const auto samples = test::points_of(*prepared, {.index = pixel}, kLight, 3, 3 * set);
      CHECK(is_moved(samples, points));
      auto spoiled = samples;
      spoiled.back().x = 0.9f;
      CHECK_FALSE(is_moved(spoiled, points));
    }
  }
  const auto first = test::points_of(*prepared, {}, kLight, 6);
  CHECK(first[0] != first[3]);  // the next set has another offset
  CHECK(first != test::points_of(*prepared, {.index = 1}, kLight, 6));
}

TEST_CASE("point_list: other content is refused with its line") {
  CHECK(
      message_of("0.1 0.2\n0.3 1\n").find("points.txt:2: error: expected two numbers in [0, 1)") !=
      std::string::npos);
  for (const char* wrong :
       {"0.5\n", "0.5 0.5 0.5\n", "-0.1 0.5\n", "nan 0.5\n", "0.5,0.5\n", "x y\n"}) {
    CAPTURE(wrong);
    CHECK(message_of(wrong).find("points.txt:1: error: ") != std::string::npos);
  }
  CHECK(message_of("# only this\n").find("no points") != std::string::npos);
  std::string many;
  for (int i = 0; i < 65537; ++i) many += "0 0\n";
  CHECK(message_of(many).find("points.txt:65537: error: more than 65536 points") !=
        std::string::npos);
  CHECK_THROWS_AS(read_point_list("/nowhere/points.txt"), InputError);
}

}  // namespace pharos
