#include "../aligned_sampler.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/sampling/keyed_numbers.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>
#include <pharos/tests/fixtures.h>

#include "../point_set_library.h"
#include "probed_integrands.h"

namespace pharos::aligned {
namespace {

/// A sampler of independent numbers with a given pass size.
class BaseSampler final : public Sampler {
 public:
  explicit BaseSampler(std::uint32_t pass = 1) : pass_(pass) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid&, const SamplePlan&,
                                                 const IntegrandProbe*) const override {
    return std::make_unique<Prepared>();
  }
  std::uint32_t preferred_samples(const SamplePlan&) const override { return pass_; }

 private:
  class Prepared final : public PreparedSampler {
   public:
    std::uint64_t begin(const PathKey& key) const override { return hash_key(key); }
    float value_1d(const SampleStream& stream, Dimension dimension) const override {
      return keyed_numbers(stream.state(), dimension).x;
    }
    Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
      return keyed_numbers(stream.state(), dimension);
    }
  };
  std::uint32_t pass_;
};

constexpr PixelGrid kFilm{32, 16};
constexpr Dimension kLight{Purpose::light_position, 1};
constexpr SamplePlan kPlan{.seed = 3, .samples_per_pixel = 64};

AlignedSettings settings() {
  return {.base = std::make_shared<BaseSampler>()};
}

AlignedSettings stated(double angle) {
  AlignedSettings s = settings();
  s.angles = {angle};
  return s;
}

Vec2 base_number(const PathKey& key, Dimension dimension) {
  return keyed_numbers(hash_key(key), dimension);
}

std::vector<Vec2> points_of(const PreparedSampler& sampler, PathKey key, Dimension dimension,
                            std::uint32_t count = 64, std::uint32_t first = 0) {
  std::vector<Vec2> points;
  for (key.sample = first; key.sample < first + count; ++key.sample) {
    points.push_back(SampleStream(sampler, key).get_2d(dimension));
  }
  return points;
}

using Steps = std::pair<std::uint32_t, std::uint32_t>;

/// Returns the positions in steps of 2^-24.
std::multiset<Steps> steps_of(const std::vector<Vec2>& points) {
  std::multiset<Steps> steps;
  for (const Vec2 p : points) {
    steps.emplace(static_cast<std::uint32_t>(p.x * 0x1p24f),
                  static_cast<std::uint32_t>(p.y * 0x1p24f));
  }
  return steps;
}

/// Returns the toroidal shift that moves a set to the points, in steps of 2^-24; none if they are
/// not the points of the set.
std::optional<Steps> shift_of(const std::vector<Vec2>& points, const PointSet& set) {
  const std::multiset<Steps> found = steps_of(points);
  const Steps first = *found.begin();
  for (const GridPoint start : set) {
    const std::uint32_t x = first.first - (std::uint32_t{start.x} << 8);
    const std::uint32_t y = first.second - (std::uint32_t{start.y} << 8);
    std::multiset<Steps> moved;
    for (const GridPoint p : set) {
      moved.emplace((x + (std::uint32_t{p.x} << 8)) & 0xffffff,
                    (y + (std::uint32_t{p.y} << 8)) & 0xffffff);
    }
    if (moved == found) return Steps{x, y};
  }
  return std::nullopt;
}

bool is_shifted_set(const std::vector<Vec2>& points, const PointSet& set) {
  return shift_of(points, set).has_value();
}

PointSet set_of(double angle) {
  return PointSetLibrary({}).find(std::vector{angle}, 64);
}

}  // namespace

TEST_CASE("aligned: a pixel's points are those of the set, moved") {
  const auto sampler = AlignedSampler(stated(30)).prepare(kFilm, kPlan, nullptr);
  const PointSet set = set_of(30);
  for (const PathKey& key : {PathKey{.seed = 3}, PathKey{.seed = 3, .index = 77},
                             PathKey{.seed = 9, .iteration = 2, .index = 100'000}}) {
    CHECK(is_shifted_set(points_of(*sampler, key, kLight), set));
    CHECK(is_shifted_set(points_of(*sampler, key, kLight, 64, 64 * 5), set));
    CHECK_FALSE(is_shifted_set(points_of(*sampler, key, kLight), set_of(31)));
    CHECK_FALSE(is_shifted_set(points_of(*sampler, key, kLight, 64, 32), set));
  }
}

TEST_CASE("aligned: ordered choices take points at even distances along the normal") {
  constexpr Dimension kChoice{Purpose::mix_choice, 1}, kDirection{Purpose::bsdf_direction, 1};
  AlignedSettings ordered = stated(30);
  ordered.purposes = {Purpose::bsdf_direction};
  ordered.ordered_choice = true;
  const auto sampler = AlignedSampler(ordered).prepare(kFilm, kPlan, nullptr);
  const PathKey key{.seed = 3, .index = 77};
  const std::vector<Vec2> points = points_of(*sampler, key, kDirection);
  const std::optional<Steps> shift = shift_of(points, set_of(30));
  REQUIRE(shift);
  /// A sample's place along the normal before the shift, and its choice.
  std::vector<std::pair<double, float>> along;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const auto before = [](float x, std::uint32_t by) {
      return (static_cast<std::uint32_t>(x * 0x1p24f) - by) & 0xffffff;
    };
    const double place = std::cos(radians(30)) * before(points[i].x, shift->first) +
                         std::sin(radians(30)) * before(points[i].y, shift->second);
    PathKey sample = key;
    sample.sample = i;
    along.emplace_back(place, SampleStream(*sampler, sample).get_1d(kChoice));
  }
  std::ranges::sort(along);
  for (std::size_t rank = 0; rank < 64; ++rank) {
    double expected = along[0].second;
    for (std::size_t bit = 0; bit < 6; ++bit)
      expected += std::ldexp(rank >> bit & 1, -1 - static_cast<int>(bit));
    CHECK(along[rank].second == doctest::Approx(expected - std::floor(expected)).epsilon(1e-5));
  }
}

TEST_CASE("aligned: without ordered choices, they are numbers of the base") {
  const auto sampler = AlignedSampler(stated(30)).prepare(kFilm, kPlan, nullptr);
  const PathKey key{.seed = 3, .index = 77};
  constexpr Dimension kChoice{Purpose::mix_choice, 1};
  CHECK(SampleStream(*sampler, key).get_1d(kChoice) == base_number(key, kChoice).x);
}

TEST_CASE("aligned: pixels, sets, lights, seeds and iterations have other offsets and orders") {
  const auto sampler = AlignedSampler(stated(30)).prepare(kFilm, kPlan, nullptr);
  const PathKey key{.seed = 3, .index = 5};
  const auto here = points_of(*sampler, key, kLight);
  const std::vector<std::vector<Vec2>> others{
      points_of(*sampler, {.seed = 3, .index = 6}, kLight),
      points_of(*sampler, {.seed = 4, .index = 5}, kLight),
      points_of(*sampler, {.seed = 3, .iteration = 1, .index = 5}, kLight),
      points_of(*sampler, key, kLight, 64, 64),
      points_of(*sampler, key, {Purpose::light_position, 1, 1})};
  for (const auto& other : others) {
    CHECK_FALSE(steps_of(other) == steps_of(here));
    // If the orders were the same, all differences modulo one would be the same.
    std::set<Steps> differences;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const Vec2 d = other[i] - here[i];
      differences.emplace(static_cast<std::uint32_t>((d.x - std::floor(d.x)) * 0x1p24f),
                          static_cast<std::uint32_t>((d.y - std::floor(d.y)) * 0x1p24f));
    }
    CHECK(differences.size() > 16);
  }
}

TEST_CASE("aligned: all else is the base's") {
  AlignedSettings s = stated(30);
  s.lights = 2;
  const auto sampler = AlignedSampler(s).prepare(kFilm, kPlan, nullptr);
  const PathKey key{.seed = 3, .index = 5, .sample = 11};
  const SampleStream stream(*sampler, key);
  for (const Dimension d :
       {Dimension{Purpose::pixel}, Dimension{Purpose::lens}, Dimension{Purpose::bsdf_direction, 1},
        Dimension{Purpose::light_position, 2}, Dimension{Purpose::light_position, 1, 2}}) {
    CHECK(stream.get_2d(d) == base_number(key, d));
  }
  CHECK(stream.get_1d(kLight) == base_number(key, kLight).x);
  CHECK_FALSE(stream.get_2d(kLight) == base_number(key, kLight));
  CHECK_FALSE(stream.get_2d({Purpose::light_position, 1, 1}) ==
              base_number(key, {Purpose::light_position, 1, 1}));
}

TEST_CASE("aligned: lens and directions where they are asked for") {
  AlignedSettings s = stated(30);
  s.purposes = {Purpose::lens, Purpose::bsdf_direction};
  const auto sampler = AlignedSampler(s).prepare(kFilm, kPlan, nullptr);
  CHECK(is_shifted_set(points_of(*sampler, {}, {Purpose::lens}), set_of(30)));
  CHECK(is_shifted_set(points_of(*sampler, {}, {Purpose::bsdf_direction, 1}), set_of(30)));
  CHECK(SampleStream(*sampler, {}).get_2d(kLight) == base_number({}, kLight));
}

TEST_CASE("aligned: each block has the set of its own edges") {
  const test::FunctionProbe probe(kFilm, [](int x, int, Dimension, Vec2 u) {
    return x < 16 ? test::half_plane(40, {0.5f, 0.5f})(u) : 1.0f;
  });
  const AlignedSampler aligned(settings());
  CHECK(aligned.needs_probe());
  const DirectionField field = aligned.estimate(&probe, kPlan.seed);
  REQUIRE(field.at(0, 0).count == 1);
  const int found = field.at(0, 0).degrees[0];
  const auto sampler = aligned.prepare(kFilm, kPlan, &probe);
  CHECK(is_shifted_set(points_of(*sampler, {.seed = 3, .index = 15}, kLight), set_of(found)));
  const PathKey right{.seed = 3, .index = 16};
  CHECK(SampleStream(*sampler, right).get_2d(kLight) == base_number(right, kLight));
}

TEST_CASE("aligned: numbers are uniform over pixels, for any sample") {
  std::vector<double> p_values;
  for (const double angle : {10.0, 45.0, 130.0}) {
    const auto sampler = AlignedSampler(stated(angle)).prepare(kFilm, kPlan, nullptr);
    for (const std::uint32_t sample : {0u, 37u, 1'000'000u}) {
      std::uint64_t pixel = 0;
      const auto draw = [&](RandomStream&) -> std::optional<Vec2> {
        return SampleStream(*sampler, {.index = pixel++, .sample = sample}).get_2d(kLight);
      };
      const auto fit = statistics::fit_square_density(draw, [](Vec2) { return 1.0; },
                                                      {.draws = 40'000, .cells = 100});
      CHECK(fit.is_density());
      p_values.push_back(fit.chi_square.p_value);
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("aligned: lights of a pixel are uncorrelated") {
  const auto sampler = AlignedSampler(stated(30)).prepare(kFilm, kPlan, nullptr);
  std::vector<double> sums;
  for (std::uint64_t pixel = 0; pixel < 2000; ++pixel) {
    double sum = 0;
    for (std::uint32_t i = 0; i < 16; ++i) {
      const SampleStream stream(*sampler, {.index = pixel, .sample = i});
      sum += (stream.get_2d(kLight).x - 0.5) *
             (stream.get_2d({Purpose::light_position, 1, 1}).x - 0.5);
    }
    sums.push_back(sum);
  }
  CHECK(statistics::one_sample_test(statistics::estimate(statistics::moments(sums)), 0).p_value >
        0.01);
}

TEST_CASE("aligned: sets are as large as the samples of a pixel allow") {
  const AlignedSampler aligned(stated(30));
  CHECK(aligned.set_size(0) == 64);
  CHECK(aligned.set_size(64) == 64);
  CHECK(aligned.set_size(255) == 64);
  CHECK(aligned.set_size(256) == 256);
  CHECK(aligned.set_size(1'000'000) == 4096);
  AlignedSettings any = stated(30);
  any.synthesize = true;
  CHECK(AlignedSampler(any).set_size(255) == 128);
  CHECK(AlignedSampler(any).set_size(1'000'000) == 65536);
  AlignedSettings fixed = stated(30);
  fixed.samples = 1024;
  CHECK(AlignedSampler(fixed).set_size(64) == 1024);
}

TEST_CASE("aligned: passes are whole sets where their size is stated, or the time is") {
  AlignedSettings s = stated(30);
  CHECK(AlignedSampler(s).preferred_samples({}) == 64);
  CHECK(AlignedSampler(s).preferred_samples({.samples_per_pixel = 500}) == 1);
  s.samples = 256;
  CHECK(AlignedSampler(s).preferred_samples({.samples_per_pixel = 500}) == 256);
  s.base = std::make_shared<BaseSampler>(6);
  CHECK(AlignedSampler(s).preferred_samples({}) == 768);
}

TEST_CASE("aligned: with fewer samples than the smallest set nothing is looked at") {
  const PathKey key{.index = 4, .sample = 3};
  const auto few = AlignedSampler(settings()).prepare(kFilm, {.samples_per_pixel = 63}, nullptr);
  CHECK(SampleStream(*few, key).get_2d(kLight) == base_number(key, kLight));
}

TEST_CASE("aligned: settings that do not fit are refused") {
  const auto error = [](auto&& change) {
    return pharos::test::input_error([&] {
      AlignedSettings s = settings();
      change(s);
      AlignedSampler sampler(s);
    });
  };
  CHECK(error([](AlignedSettings& s) { s.estimation.grid.tiles = 5; }) ==
        "a grid of 96 cells cannot be divided into 5 tiles along an axis");
  CHECK(error([](AlignedSettings& s) {
          s.angles = {20, 70};
        }) == "3 directions are both axes and 1 more, found 2 angles");
  CHECK(error([](AlignedSettings& s) {
          s.angles = {20, 70};
          s.directions = 4;
        }) == "no error");
  CHECK(pharos::test::input_error([] {
          AlignedSampler(settings()).prepare(kFilm, kPlan, nullptr);
        }).starts_with("the sampler 'aligned' looks at integrands before rendering"));
}

}  // namespace pharos::aligned
