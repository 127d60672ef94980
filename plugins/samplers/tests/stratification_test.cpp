#include <cmath>
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

/// Whether the points fill each cell of a grid of 2^a by 2^b cells exactly once.
bool fills_grid(const std::vector<Vec2>& points, int a, int b) {
  std::vector<int> counts(points.size());
  for (const Vec2 p : points) {
    const auto x = static_cast<std::size_t>(p.x * std::exp2(a));
    const auto y = static_cast<std::size_t>(p.y * std::exp2(b));
    ++counts[(y << a) + x];
  }
  for (const int count : counts) {
    if (count != 1) return false;
  }
  return true;
}

/// Mean squared error, over pixels, of the integral of x y from n samples.
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

}  // namespace

TEST_CASE("Sobol' points: the first ones of the sequence") {
  const double x[] = {0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};
  const double y[] = {0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875};
  for (std::uint32_t i = 0; i < 8; ++i) {
    CHECK(fraction(owen::sobol_x_reversed(i)) == x[i]);
    CHECK(fraction(owen::sobol_y_reversed(i)) == y[i]);
  }
  // The second dimension's direction numbers: v_j = v_(j-1) xor (v_(j-1) >> 1).
  std::uint32_t direction = 0x80000000u;
  for (int bit = 0; bit < 32; ++bit) {
    CHECK(owen::reverse_bits(owen::sobol_y_reversed(1u << bit)) == direction);
    direction ^= direction >> 1;
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

TEST_CASE("sobol: the first 2^k samples are stratified in every elementary interval") {
  const auto sampler = SobolSampler().prepare({}, {}, nullptr);
  const Dimension dimensions[] = {{Purpose::pixel}, {Purpose::light_position, 2, 5}};
  for (std::uint64_t pixel = 0; pixel < 10; ++pixel) {
    for (const Dimension dimension : dimensions) {
      for (int k = 0; k <= 10; ++k) {
        std::vector<Vec2> points;
        for (std::uint32_t i = 0; i < (1u << k); ++i) {
          const SampleStream stream(*sampler, {.seed = 9, .index = pixel, .sample = i});
          points.push_back(stream.get_2d(dimension));
        }
        for (int a = 0; a <= k; ++a) CHECK(fills_grid(points, a, k - a));
      }
    }
  }
}

TEST_CASE("sobol: the first 2^k 1D samples are stratified") {
  const auto sampler = SobolSampler().prepare({}, {}, nullptr);
  for (int k = 0; k <= 10; ++k) {
    std::vector<Vec2> points;
    for (std::uint32_t i = 0; i < (1u << k); ++i) {
      points.push_back(
          {SampleStream(*sampler, {.index = 4, .sample = i}).get_1d({Purpose::bsdf_choice, 1}), 0});
    }
    CHECK(fills_grid(points, k, 0));
  }
}

TEST_CASE("sobol: smooth integrals converge faster than with independent samples") {
  const auto sobol = SobolSampler().prepare({}, {}, nullptr);
  const auto independent = IndependentSampler().prepare({}, {}, nullptr);
  // Variance of x y is 7/144; Owen-scrambled nets err by about n^-3.
  CHECK(integration_error(*independent, 64) == doctest::Approx(7.0 / 144 / 64).epsilon(0.4));
  CHECK(integration_error(*sobol, 64) < 0.02 * integration_error(*independent, 64));
  CHECK(integration_error(*sobol, 256) < integration_error(*sobol, 64) / 20);
}

}  // namespace pharos
