#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "../independent.h"
#include "../owen.h"
#include "../sobol.h"

namespace pharos {
namespace {

double fraction(std::uint32_t reversed) {
  return owen::reverse_bits(reversed) * 0x1p-32;
}

/// Returns the mean squared error, over pixels, of the integral of x y from n samples.
double integration_error(const PreparedSampler& sampler, std::uint32_t n) {
  constexpr int kPixels = 200;
  double error = 0;
  for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel) {
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const Vec2 u = SampleStream(sampler, {.index = pixel, .sample = i}).get_2d({Purpose::lens});
      sum += double{u.x} * u.y / n;
    }
    error += (sum - 0.25) * (sum - 0.25) / kPixels;
  }
  return error;
}

/// Returns the smallest and the largest number of points in the boxes of 2^a x 2^b x 2^c x 2^d
/// intervals, where bits = {a, b, c, d}.
std::pair<int, int> points_in_boxes(const std::vector<std::array<float, 4>>& points,
                                    const std::array<int, 4>& bits) {
  std::vector<int> counts(std::size_t{1} << (bits[0] + bits[1] + bits[2] + bits[3]));
  for (const std::array<float, 4>& p : points) {
    std::size_t box = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      box = (box << bits[i]) + static_cast<std::size_t>(std::ldexp(p[i], bits[i]));
    }
    ++counts[box];
  }
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  return {*least, *most};
}

}  // namespace

TEST_CASE("Sobol' points: the first ones of the sequence") {
  const double x[] = {0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};
  const double y[] = {0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875};
  for (std::uint32_t i = 0; i < 8; ++i) {
    CHECK(fraction(i) == x[i]);
    CHECK(fraction(owen::sobol_y_reversed(i)) == y[i]);
  }
  // The direction numbers of the second dimension: v_j = v_(j-1) xor (v_(j-1) >> 1).
  std::uint32_t direction = 0x80000000u;
  for (int bit = 0; bit < 32; ++bit) {
    CHECK(owen::reverse_bits(owen::sobol_y_reversed(1u << bit)) == direction);
    direction ^= direction >> 1;
  }
}

TEST_CASE("Sobol' points: the table has those that the matrices give") {
  RandomStream random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto index = static_cast<std::uint32_t>(random());
    const std::uint64_t point = owen::sobol_reversed(owen::reverse_bits(index));
    CHECK(static_cast<std::uint32_t>(point) == index);
    CHECK(static_cast<std::uint32_t>(point >> 32) == owen::sobol_y_reversed(index));
  }
}

TEST_CASE("Sobol' points: the first ones of the third and fourth dimension") {
  const double z[] = {0, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125};
  const double w[] = {0, 0.5, 0.75, 0.25, 0.125, 0.625, 0.875, 0.375};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint64_t pair = owen::sobol_reversed(owen::reverse_bits(i), owen::kLaterSobolParts);
    CHECK(fraction(static_cast<std::uint32_t>(pair)) == z[i]);
    CHECK(fraction(static_cast<std::uint32_t>(pair >> 32)) == w[i]);
  }
}

TEST_CASE("sobol: choices and the points that they choose are a net") {
  constexpr int kBits = 9;  // 512 samples
  const auto sobol = SobolSampler().prepare({}, {}, nullptr);
  struct Group {
    Purpose points, choice, other_choice;
  };
  for (const Group& group :
       {Group{Purpose::bsdf_direction, Purpose::mix_choice, Purpose::bsdf_choice},
        Group{Purpose::guide_direction, Purpose::mix_choice, Purpose::bsdf_choice},
        Group{Purpose::light_position, Purpose::light_choice, Purpose::light_choice}}) {
    std::vector<std::array<float, 4>> points;
    for (std::uint32_t i = 0; i < (1u << kBits); ++i) {
      const SampleStream numbers(*sobol, {.seed = 4, .index = 17, .sample = i});
      const auto at = [](Purpose purpose) { return Dimension{purpose, 2, 3}; };
      const Vec2 p = numbers.get_2d(at(group.points));
      points.push_back(
          {p.x, p.y, numbers.get_1d(at(group.choice)), numbers.get_1d(at(group.other_choice))});
    }
    // The first three dimensions are a (1, 3)-sequence, all four a (3, 4)-sequence.
    for (int a = 0; a < kBits; ++a) {
      for (int b = 0; a + b < kBits; ++b) {
        CHECK(points_in_boxes(points, {a, b, kBits - 1 - a - b, 0}) == std::pair(2, 2));
        if (group.other_choice == group.choice) continue;
        for (int c = 0; a + b + c <= kBits - 3; ++c) {
          CHECK(points_in_boxes(points, {a, b, c, kBits - 3 - a - b - c}) == std::pair(8, 8));
        }
      }
    }
  }
}

TEST_CASE("Owen scrambling: a digit depends on itself and those before it alone") {
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto v = static_cast<std::uint32_t>(random()),
               seed = static_cast<std::uint32_t>(random());
    const int digit = static_cast<int>(random() % 32);
    const std::uint32_t changed = v ^ (1u << digit);
    const std::uint32_t difference =
        owen::scramble_reversed(v, seed) ^ owen::scramble_reversed(changed, seed);
    CHECK((difference & ((1u << digit) - 1)) == 0);
    CHECK(((difference >> digit) & 1) == 1);
    CHECK(owen::reverse_bits(owen::reverse_bits(v)) == v);
  }
}

TEST_CASE("sobol: smooth integrals converge faster than with independent samples") {
  const auto sobol = SobolSampler().prepare({}, {}, nullptr);
  const auto independent = IndependentSampler().prepare({}, {}, nullptr);
  // The variance of x y is 7/144. The variance of Owen-scrambled nets falls as about n^-3.
  CHECK(integration_error(*independent, 64) == doctest::Approx(7.0 / 144 / 64).epsilon(0.4));
  CHECK(integration_error(*sobol, 64) < 0.02 * integration_error(*independent, 64));
  CHECK(integration_error(*sobol, 256) < integration_error(*sobol, 64) / 20);
}

}  // namespace pharos
