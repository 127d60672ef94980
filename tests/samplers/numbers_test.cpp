// Tests of the random numbers of every registered sampler.

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>

#include "subjects.h"

namespace pharos::testing {
namespace {

constexpr std::array kDimensions{Dimension{Purpose::pixel},
                                 Dimension{Purpose::lens},
                                 Dimension{Purpose::light_position, 1},
                                 Dimension{Purpose::light_position, 1, 1},
                                 Dimension{Purpose::bsdf_direction, 1},
                                 Dimension{Purpose::bsdf_direction, 2}};

/// Returns the p-value of the hypothesis that two lists of numbers in [0, 1), with `samples` per
/// pixel, are uncorrelated. Pixels are independent but the samples of one pixel are not, so the
/// error comes from the spread over pixels.
double uncorrelated_p_value(const std::vector<float>& a, const std::vector<float>& b,
                            std::size_t samples) {
  std::vector<double> sums(a.size() / samples);
  for (std::size_t i = 0; i < a.size(); ++i) sums[i / samples] += (a[i] - 0.5) * (b[i] - 0.5);
  return statistics::one_sample_test(statistics::estimate(statistics::moments(sums)), 0).p_value;
}

}  // namespace

TEST_CASE("samplers: numbers are those of the key and the dimension, in any order") {
  for (const PreparedSubject& s : prepared_samplers(300)) {
    CAPTURE(s.name);
    const PathKey key{.seed = 5, .iteration = 2, .index = 77, .sample = 13};
    const SampleStream stream(*s.sampler, key), again(*s.sampler, key);
    std::vector<Vec2> forward;
    for (const Dimension d : kDimensions) forward.push_back(stream.get_2d(d));
    for (std::size_t i = kDimensions.size(); i-- > 0;) {
      CHECK(again.get_1d(kDimensions[i]) == stream.get_1d(kDimensions[i]));
      CHECK(again.get_2d(kDimensions[i]) == forward[i]);
    }
    const Vec2 here = stream.get_2d({Purpose::lens});
    for (const PathKey& other : {PathKey{6, 2, 77, 13}, PathKey{5, 3, 77, 13},
                                 PathKey{5, 2, 78, 13}, PathKey{5, 2, 77, 14}}) {
      CHECK_FALSE(SampleStream(*s.sampler, other).get_2d({Purpose::lens}) == here);
    }
  }
}

TEST_CASE("samplers: each number is uniform over pixels, for any sample") {
  std::vector<double> p_values;
  for (const PreparedSubject& s : prepared_samplers(300)) {
    CAPTURE(s.name);
    for (const std::uint32_t sample : {0u, 3u, 1'000'000u}) {
      for (const Dimension d : kDimensions) {
        std::uint64_t pixel = 0;
        const auto draw = [&](RandomStream&) -> std::optional<Vec2> {
          return SampleStream(*s.sampler, {.index = pixel++, .sample = sample}).get_2d(d);
        };
        const auto fit = statistics::fit_square_density(draw, [](Vec2) { return 1.0; },
                                                        {.draws = 40'000, .cells = 100});
        CHECK(fit.is_density());
        p_values.push_back(fit.chi_square.p_value);
      }
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("samplers: numbers stay below one and 1D numbers are uniform") {
  for (const PreparedSubject& s : prepared_samplers(300)) {
    CAPTURE(s.name);
    double sum = 0, squares = 0;
    constexpr int kPixels = 1000, kSamples = 16;
    for (int i = 0; i < kPixels; ++i) {
      for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
        const PathKey key{.index = static_cast<std::uint64_t>(i), .sample = sample};
        const float u = SampleStream(*s.sampler, key).get_1d({Purpose::roulette, 3});
        REQUIRE(u >= 0);
        REQUIRE(u < 1);
        sum += u;
        squares += u * u;
      }
    }
    CHECK(sum / (kPixels * kSamples) == doctest::Approx(0.5).epsilon(0.02));
    CHECK(squares / (kPixels * kSamples) == doctest::Approx(1.0 / 3).epsilon(0.02));
  }
}

TEST_CASE("samplers: dimensions, pixels and seeds are uncorrelated") {
  // Tests the samples of 3,000 pixels for each pair of dimensions, within a pixel and over pixels.
  std::vector<double> p_values;
  for (const PreparedSubject& s : prepared_samplers(300)) {
    for (const std::uint32_t samples : {4u, 16u}) {
      std::vector<std::vector<float>> columns(2 * kDimensions.size() + 2);
      for (std::uint64_t pixel = 0; pixel < 3000; ++pixel) {
        for (std::uint32_t i = 0; i < samples; ++i) {
          const SampleStream stream(*s.sampler, {.index = pixel, .sample = i});
          std::size_t column = 0;
          for (const Dimension d : kDimensions) {
            const Vec2 u = stream.get_2d(d);
            columns[column++].push_back(u.x);
            columns[column++].push_back(u.y);
          }
          const SampleStream neighbor(*s.sampler, {.index = pixel + 100'000, .sample = i});
          const SampleStream other_seed(*s.sampler, {.seed = 1, .index = pixel, .sample = i});
          columns[column++].push_back(neighbor.get_1d(kDimensions[0]));
          columns[column++].push_back(other_seed.get_1d(kDimensions[0]));
        }
      }
      for (std::size_t a = 0; a < columns.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          p_values.push_back(uncorrelated_p_value(columns[a], columns[b], samples));
        }
      }
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

}  // namespace pharos::testing
