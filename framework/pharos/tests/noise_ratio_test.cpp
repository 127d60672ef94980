// Tests of the error of guided images relative to unguided ones, estimated from guided paths.

#include <array>
#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/guiding/pipeline/noise_ratio.h>

#include "two_directions.h"

namespace pharos::test {
namespace {

constexpr PixelRect kPixel{0, 0, 1, 1};

/// Compares numbers, relative to the expected one.
doctest::Approx about(double expected) {
  return doctest::Approx(expected).epsilon(0.03).scale(0);
}

/// Ends an iteration of 100,000 paths.
void iterate(NoiseRatio& ratio, double guide, std::uint64_t seed) {
  ratio.absorb(guided_paths(guide, 100'000, seed));
  ratio.end_iteration(true);
}

/// Returns paths of one step each. Unguided sampling finds the light with the probability `chance`,
/// and a guide that has half of the samples finds it with the probability `guide`. On their way,
/// all paths find light of brightness `common`, and the mean of the rest is 1.
PathLog paths_to_rare_light(double chance, double common, int count, std::uint64_t seed,
                            Vec2 film = {}, double guide = 1) {
  PathLog log;
  RandomStream random(seed);
  const double probability = 0.5 * (guide + chance);
  for (int i = 0; i < count; ++i) {
    const bool finds = random.next_1d() < probability;
    const Rgb found(static_cast<float>(finds ? 1 / probability : 0));
    log.begin_path(film, Transport::radiance);
    log.add(RecordedVertex{.guidable = true,
                           .throughput = Rgb(1),
                           .local_weight = found,
                           .pdf = static_cast<float>(finds ? probability : 1 - probability)});
    const std::array techniques{Technique{0.5f, static_cast<float>(finds ? chance : 1 - chance)},
                                Technique{0.5f, static_cast<float>(finds ? guide : 1 - guide)}};
    log.set_techniques(0, techniques);
    log.add({.vertex = 0, .contribution = Rgb(static_cast<float>(common))});
    log.add(RecordedVertex{
        .parent = 0, .throughput = found, .emission = Rgb(1), .unguided_emission = Rgb(1)});
  }
  return log;
}

TEST_CASE("noise ratio: the quotient of the variances") {
  NoiseRatio ratio(kPixel);
  iterate(ratio, 0.5, 1);
  CHECK_FALSE(ratio.value());  // the brightness was unknown
  for (const double guide : {0.5, 0.75, 0.9, 0.99}) {
    iterate(ratio, guide, 2);
    REQUIRE(ratio.value());
    CHECK(*ratio.value() == doctest::Approx(expected_ratio(guide)).epsilon(0.03));
  }
}

TEST_CASE("noise ratio: the standard error is how much the ratio scatters") {
  constexpr PixelRect kTiles{0, 0, 64, 64};
  constexpr int kRepeats = 100;
  double sum = 0, squares = 0, errors = 0;
  for (std::uint64_t repeat = 0; repeat < kRepeats; ++repeat) {
    NoiseRatio ratio(kTiles);
    for (const std::uint64_t iteration : {0u, 1u}) {
      for (std::uint64_t tile = 0; tile < 64; ++tile) {
        const Vec2 film{8.0f * static_cast<float>(tile % 8), 8.0f * static_cast<float>(tile / 8)};
        const std::uint64_t seed = (2 * repeat + iteration) * 64 + tile;
        ratio.absorb(guided_paths(0.75, 50, seed, film));
      }
      CHECK(ratio.relative_error() == 0);
      ratio.end_iteration(true);
    }
    REQUIRE(ratio.value());
    sum += *ratio.value() / kRepeats;
    squares += *ratio.value() * *ratio.value() / kRepeats;
    errors += ratio.relative_error() / kRepeats;
  }
  CHECK(sum == doctest::Approx(expected_ratio(0.75)).epsilon(0.03));
  const double deviation = std::sqrt(squares - sum * sum) / sum;
  CHECK(errors == doctest::Approx(deviation).epsilon(0.25));
}

TEST_CASE("noise ratio: what it may fall by") {
  NoiseRatio ratio({0, 0, 16, 8});
  const auto end = [&](double left, double right, std::uint64_t seed) {
    ratio.absorb(guided_paths(left, 50'000, 2 * seed, {0, 0}));
    ratio.absorb(guided_paths(right, 50'000, 2 * seed + 1, {8, 0}));
    ratio.end_iteration(true);
  };
  end(0.5, 0.5, 1);
  end(0.5, 0.5, 2);
  CHECK_FALSE(ratio.possible_fall());
  end(0.75, 0.75, 3);
  CHECK(*ratio.possible_fall() == doctest::Approx(*ratio.fall()).epsilon(0.1));
  end(0.75, 0.5, 4);
  // One tile has the ratio r and the other one 1, so the error is (1 - r) / (1 + r).
  const double r = expected_ratio(0.75);
  CHECK(ratio.relative_error() == doctest::Approx((1 - r) / (1 + r)).epsilon(0.1));
  CHECK(*ratio.possible_fall() == doctest::Approx(*ratio.fall() + (1 - r) / (1 + r)).epsilon(0.1));
}

TEST_CASE("noise ratio: images hide no light that is not too bright for them") {
  NoiseRatio ratio(kPixel);
  CHECK(ratio.hidden_light() == 0);
  for (const std::uint64_t seed : {1u, 2u}) {
    ratio.absorb(paths_to_rare_light(0.25, 0, 1000, seed));
    ratio.end_iteration(true);
  }
  CHECK(ratio.hidden_light() == 0);
}

TEST_CASE("noise ratio: light that all paths find makes no noise") {
  for (const double common : {0.0, 3.0}) {
    NoiseRatio ratio(kPixel);
    for (const std::uint64_t seed : {1u, 2u}) {
      ratio.absorb(paths_to_rare_light(0.25, common, 100'000, seed));
      ratio.end_iteration(true);
    }
    REQUIRE(ratio.value());
    const double guided = 1 / 0.625 - 1, unguided = 1 / 0.25 - 1;
    CHECK(*ratio.value() == doctest::Approx(guided / unguided).epsilon(0.03));
  }
}

TEST_CASE("noise ratio: what distinguishes pixels makes no noise, if they have enough paths") {
  constexpr int kPaths = 40'000;
  const double guided = 1 / 0.625 - 1, unguided = 1 / 0.25 - 1;
  // Ends an iteration in which pixel x of a row has paths(x) paths and the brightness 100 x.
  const auto iterate_row = [](NoiseRatio& ratio, std::uint64_t seed, auto&& paths) {
    for (int x = 0; x < 8; ++x) {
      const Vec2 film{static_cast<float>(x), 0};
      ratio.absorb(paths_to_rare_light(0.25, 100 * x, paths(x), 10 * seed + x, film));
    }
    ratio.end_iteration(true);
  };
  const auto ratio_with = [&](auto&& paths) {
    NoiseRatio ratio({0, 0, 8, 1});
    for (const std::uint64_t seed : {1u, 2u}) iterate_row(ratio, seed, paths);
    REQUIRE(ratio.value());
    return *ratio.value();
  };
  CHECK(ratio_with([](int) { return kPaths; }) == about(guided / unguided));
  // Otherwise the tile counts as one pixel, and the differences hide the noise.
  CHECK(ratio_with([](int) { return 1; }) == about(1));
  CHECK(ratio_with([](int x) { return 100 + x; }) == about(1));
}

TEST_CASE("noise ratio: unguided paths have their own MIS weights") {
  // Half of the paths find both lights.
  NoiseRatio ratio(kPixel);
  RandomStream random(1);
  for (int iteration = 0; iteration < 2; ++iteration) {
    PathLog log;
    for (int i = 0; i < 100'000; ++i) {
      const float found = random.next_1d() < 0.5f ? 1 : 0;
      log.begin_path({}, Transport::radiance);
      log.add(RecordedVertex{.throughput = Rgb(1)});
      log.add({.vertex = 0,
               .contribution = Rgb(0.5f * found),
               .mis_weight = 0.25f,
               .unguided_mis_weight = 0.75f});
      log.add(RecordedVertex{.parent = 0,
                             .throughput = Rgb(found),
                             .emission = Rgb(0.6f),
                             .unguided_emission = Rgb(0.2f)});
    }
    ratio.absorb(log);
    ratio.end_iteration(true);
  }
  REQUIRE(ratio.value());
  const double guided = 0.5 + 0.6, unguided = 1.5 + 0.2;
  CHECK(*ratio.value() == about(guided * guided / (unguided * unguided)));
}

TEST_CASE("noise ratio: light that images do not show counts as missing") {
  constexpr double kChance = 1.0 / 1024, kSamples = 128;
  NoiseRatio ratio(kPixel);
  for (const std::uint64_t seed : {1u, 2u}) {
    ratio.absorb(paths_to_rare_light(kChance, 0, 100'000, seed));
    ratio.end_iteration(true);
  }
  const double shown = kSamples * kChance;
  const double unguided = kSamples * shown - shown * shown + kSamples * (1 - shown) * (1 - shown);
  const double guided = 2 / (1 + kChance) - 1;
  REQUIRE(ratio.value());
  CHECK(*ratio.value() == doctest::Approx(guided / unguided).epsilon(0.03));
  CHECK(*ratio.value() > 5 * guided / (1 / kChance - 1));  // the quotient of the variances
  CHECK(ratio.hidden_light() == doctest::Approx(1 - shown).epsilon(0.01));
}

TEST_CASE("noise ratio: where images show next to nothing, the light that they show decides") {
  constexpr double kChance = 1.0 / 16384, kGuide = 1.0 / 256;
  NoiseRatio ratio(kPixel);
  for (const std::uint64_t seed : {1u, 2u}) {
    ratio.absorb(paths_to_rare_light(kChance, 0, 1'000'000, seed, {}, kGuide));
    ratio.end_iteration(true);
  }
  REQUIRE(ratio.value());
  // The quotient of the errors would be 0.8, because even guided images show only a quarter of the
  // light.
  CHECK(*ratio.value() == about(2 * kChance / (kChance + kGuide)));
}

TEST_CASE("noise ratio: paths of several guided steps that find light at each vertex") {
  // Each step finds the light 1 with probability 1/2 unguided and 3/4 guided, and goes on from
  // there.
  constexpr double kUnguided = 0.5, kMixed = 0.75;
  NoiseRatio ratio(kPixel);
  RandomStream random(1);
  double sum = 0, squares = 0, unguided_squares = 0;
  constexpr int kCount = 200'000;
  for (const bool first : {true, false}) {
    PathLog log;
    for (int i = 0; i < kCount; ++i) {
      log.begin_path({}, Transport::radiance);
      double throughput = 1, found = 0;
      for (std::uint32_t step = 0; step < 3; ++step) {
        const bool lit = random.next_1d() < kMixed;
        const double p = lit ? kMixed : 1 - kMixed, p_u = lit ? kUnguided : 1 - kUnguided;
        const std::array techniques{Technique{0.5f, static_cast<float>(p_u)},
                                    Technique{0.5f, static_cast<float>(2 * p - p_u)}};
        log.add(RecordedVertex{.guidable = true,
                               .parent = step == 0 ? kNoVertex : step - 1,
                               .throughput = Rgb(static_cast<float>(throughput)),
                               .pdf = static_cast<float>(p),
                               .emission = Rgb(step == 0 ? 0.0f : 1.0f),
                               .unguided_emission = Rgb(step == 0 ? 0.0f : 1.0f)});
        log.set_techniques(step, techniques);
        if (step > 0) found += throughput;
        throughput *= lit ? p_u / p * (1 / kUnguided) : 0;
        if (!lit) break;
      }
      sum += found, squares += found * found;
    }
    ratio.absorb(log);
    ratio.end_iteration(true);
    if (first) sum = squares = 0;
  }
  // What an unguided path finds: 2 after a first success, and 2 x 2 more after a second one, with
  // probability 1/2 each.
  const double mean = 0.5 * 2 + 0.25 * 4;
  unguided_squares = 0.25 * 2 * 2 + 0.25 * 6 * 6;
  CHECK(sum / kCount == about(mean));
  REQUIRE(ratio.value());
  CHECK(*ratio.value() ==
        about((squares / kCount - mean * mean) / (unguided_squares - mean * mean)));
}

TEST_CASE("noise ratio: each tile counts by its error over its brightness") {
  // A second tile, of a fourth of the brightness and without guiding.
  NoiseRatio ratio({0, 0, 16, 8});
  for (const std::uint64_t seed : {1u, 2u}) {
    ratio.absorb(guided_paths(0.9, 100'000, seed));
    const PathLog source = guided_paths(0.5, 100'000, seed);
    PathLog dark;
    for (std::size_t i = 0; i < source.size(); ++i) {
      dark.begin_path({8, 0}, Transport::radiance);
      for (const RecordedVertex& vertex : source[i].vertices) {
        RecordedVertex copy = vertex;
        copy.emission = copy.unguided_emission = copy.emission * 0.25f;
        copy.next = copy.twin = kNoVertex;
        const std::uint32_t index = dark.add(copy);
        dark.set_techniques(index, source[i].techniques(vertex));
      }
    }
    ratio.absorb(dark);
    ratio.end_iteration(true);
  }
  REQUIRE(ratio.value());
  CHECK(*ratio.value() == doctest::Approx((expected_ratio(0.9) + 0.25) / 1.25).epsilon(0.03));
}

TEST_CASE("noise ratio: it falls from one iteration to the next") {
  NoiseRatio ratio(kPixel);
  iterate(ratio, 0.5, 1);
  iterate(ratio, 0.75, 2);
  CHECK_FALSE(ratio.fall());
  iterate(ratio, 0.9, 3);
  const double next = expected_ratio(0.9) * expected_ratio(0.9) / expected_ratio(0.75);
  CHECK(*ratio.value() * std::exp(-*ratio.fall()) == about(next));
}

TEST_CASE("noise ratio: without light there is none, and unguided iterations change nothing") {
  NoiseRatio ratio(kPixel);
  ratio.absorb(guided_paths(0.5, 1000, 1));
  ratio.end_iteration(false);
  CHECK_FALSE(ratio.value());
  iterate(ratio, 0.9, 2);
  CHECK(ratio.value());
  ratio.absorb(guided_paths(0.5, 1000, 3));
  ratio.end_iteration(false);
  REQUIRE(ratio.value());
  CHECK(*ratio.value() == about(expected_ratio(0.9)));
  ratio.end_iteration(true);
  CHECK_FALSE(ratio.value());
}

TEST_CASE("noise ratio: saved in the middle of an iteration, it ends the same") {
  constexpr PixelRect kPixels{0, 0, 2, 1};
  NoiseRatio ratio(kPixels), resumed(kPixels);
  iterate(ratio, 0.5, 1);
  iterate(ratio, 0.75, 2);
  const auto absorb_both_pixels = [](NoiseRatio& each, std::uint64_t seed) {
    each.absorb(guided_paths(0.9, 100, seed));
    each.absorb(paths_to_rare_light(0.25, 100, 100, seed, {1, 0}));
  };
  absorb_both_pixels(ratio, 3);
  std::ostringstream out;
  save(out, ratio);
  std::istringstream in(out.str());
  load(in, resumed);
  for (NoiseRatio* each : {&ratio, &resumed}) {
    absorb_both_pixels(*each, 4);
    each->end_iteration(true);
  }
  CHECK(resumed.value() == ratio.value());
  CHECK(resumed.fall() == ratio.fall());
}

}  // namespace
}  // namespace pharos::test
