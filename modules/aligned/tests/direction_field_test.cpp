#include "../direction_field.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <pharos/statistics/hypothesis.h>

#include "../aligned_dimensions.h"
#include "probed_integrands.h"

namespace pharos::aligned {
namespace {

constexpr PixelGrid kFilm{64, 32};
constexpr Dimension kFirst{Purpose::light_position, 1, 0}, kSecond{Purpose::light_position, 1, 1};

/// An occluder covers the first light. The normal of its edge turns from block to block: the
/// further right the block, the larger the angle. The second light has no edge.
test::FunctionProbe turning_edges() {
  return {kFilm,
          [](int x, int y, Dimension dimension, Vec2 u) {
            if (dimension.branch() == 1) return 1.0f;
            const double direction = 20 + 40.0 * (x / 16);
            const float place = 0.4f + 0.01f * static_cast<float>(y % 16);
            return test::half_plane(direction, {place, 0.5f})(u);
          },
          {},
          2};
}

DirectionField field_of(const IntegrandProbe& probe, std::uint64_t seed = 1) {
  return estimate_directions(probe, {kFirst, kSecond}, {}, 1, seed);
}

}  // namespace

TEST_CASE("direction field: each block's and each light's own") {
  const DirectionField field = field_of(turning_edges());
  REQUIRE(field.regions().count() == 8);
  for (std::size_t region = 0; region < 8; ++region) {
    CAPTURE(region);
    const auto column = static_cast<int>(region % 4);
    REQUIRE(field.at(0, region).count == 1);
    CHECK(degrees_between(field.at(0, region).degrees[0], 20 + 40 * column) <= 2);
    CHECK(field.at(1, region).count == 0);
  }
}

TEST_CASE("direction field: the same for any number of threads, another for another seed") {
  const test::FunctionProbe probe = turning_edges();
  const auto with_threads = [&](int threads) {
    std::vector<FreeDirections> all;
    tbb::task_arena(threads).execute([&] {
      const DirectionField field = field_of(probe);
      for (std::size_t region = 0; region < field.regions().count(); ++region) {
        all.push_back(field.at(0, region));
        all.push_back(field.at(1, region));
      }
    });
    return all;
  };
  const auto one = with_threads(1);
  for (const int threads : {2, 3, 7}) CHECK(with_threads(threads) == one);
  // Directions are whole degrees, which rarely differ between seeds. The probed points differ
  // between seeds.
  const auto asked = [](std::uint64_t seed) {
    std::vector<Vec2> points;
    const test::FunctionProbe listening({16, 16}, [&](int, int, Dimension, Vec2 u) {
      points.push_back(u);
      return 0.0f;
    });
    tbb::task_arena(1).execute([&] { estimate_directions(listening, {kFirst}, {}, 1, seed); });
    return points;
  };
  CHECK(asked(1) == asked(1));
  CHECK_FALSE(asked(1) == asked(2));
  CHECK(asked(1).size() == ProbeGrid().size());
}

TEST_CASE("direction field: nothing is asked of regions that are not rendered") {
  test::FunctionProbe probe = turning_edges();
  probe.set_window({20, 17, 22, 32});
  const DirectionField field = field_of(probe), whole = field_of(turning_edges());
  REQUIRE(field.regions().count() == 8);
  for (std::size_t region = 0; region < 8; ++region) {
    CHECK(field.at(0, region) == (region == 5 ? whole.at(0, region) : FreeDirections{}));
  }
}

TEST_CASE("direction field: what is left over of lights has the mean of the pixels' paths") {
  // The integrand is brighter toward one corner of the square, so tiles differ.
  const test::FunctionProbe probe(
      {8, 8}, [](int, int, Dimension, Vec2 u) { return u.x * u.x * (u.y < 0.3f ? 1.0f : 0.0f); });
  const Dimension lens{Purpose::lens};
  const auto left_over = [&](Dimension dimension, bool reuse, std::uint64_t seed) {
    const EstimationSettings settings{
        .block = 8, .grid = {.cells = 12, .tiles = 3}, .reuse = reuse};
    return estimate_directions(probe, {dimension}, settings, 1, seed).samples();
  };
  CHECK(left_over(kFirst, false, 1).empty());
  CHECK(left_over(lens, true, 1).empty());
  // The samples of each half of the pixels: every pixel may get any tile.
  std::vector<double> halves[2];
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::vector<FilmSample> samples = left_over(kFirst, true, seed);
    REQUIRE(samples.size() == 9);
    for (const FilmSample& sample : samples) {
      halves[sample.film.y < 4].push_back(sample.radiance.g - test::FunctionProbe::kRest);
    }
  }
  for (const auto& values : halves) {
    const auto moments = statistics::moments(values);
    const double deviation = std::sqrt(moments.variance / static_cast<double>(values.size()));
    CHECK(std::abs(moments.mean - 0.1) < 4 * deviation);  // mean of u.x^2 (1/3) times 0.3
    CHECK(deviation < 3e-3);
  }
}

TEST_CASE("direction field: what is not finite has no edge") {
  const test::FunctionProbe probe({16, 16}, [](int, int, Dimension, Vec2 u) {
    return u.x + u.y > 1 ? std::numeric_limits<float>::infinity() : 0.0f;
  });
  CHECK(estimate_directions(probe, {kFirst}, {}, 1, 1).at(0, 0).count == 0);
}

TEST_CASE("aligned dimensions: those of the lens and of the first hit") {
  const std::vector<Purpose> purposes{Purpose::light_position, Purpose::lens,
                                      Purpose::bsdf_direction, Purpose::lens};
  const std::vector<Dimension> all = aligned_dimensions(purposes, 3);
  CHECK(all == std::vector<Dimension>{{Purpose::light_position, 1, 0},
                                      {Purpose::light_position, 1, 1},
                                      {Purpose::light_position, 1, 2},
                                      {Purpose::lens},
                                      {Purpose::bsdf_direction, 1}});
  const DimensionPlaces places(all);
  for (std::size_t i = 0; i < all.size(); ++i) CHECK(places.find(all[i]) == static_cast<int>(i));
  for (const Dimension other :
       {Dimension{Purpose::light_position, 1, 3}, Dimension{Purpose::light_position, 2},
        Dimension{Purpose::lens, 1}, Dimension{Purpose::bsdf_direction, 1, 1},
        Dimension{Purpose::pixel}, Dimension{Purpose::roulette, 1}}) {
    CHECK(places.find(other) == -1);
  }
}

}  // namespace pharos::aligned
