// Tests of known slopes and known variances.

#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "measured.h"

namespace pharos::laboratory {
namespace {

TEST_CASE("slopes of independent and of Sobol' points are those of theory") {
  const LaboratoryResults results = measured(std::string(kTwo) +
                                             "samples: { from: 4, to: 11 }\n"
                                             "realizations: 400\nspectrum: { points: 0 }\n");
  const auto slope = [&](std::size_t s, std::size_t i) { return *results.samplers[s].slopes[i]; };
  for (const std::size_t i : {0u, 1u}) {
    const VarianceSlope random = slope(0, i);
    CHECK(random.slope.interval.low <= -1);
    CHECK(random.slope.interval.high >= -1);
    CHECK(std::abs(random.slope.value + 1) < 0.05);
    CHECK(random.misfit < 3);
  }
  CHECK(slope(1, 0).slope.value == doctest::Approx(-1.5).epsilon(0.05));
  CHECK(slope(1, 1).slope.value < -2);
  CHECK(results.samplers[0].spectrum.empty());
}

/// The slopes of one sampler, given as YAML, on the edge and the smooth function of kIntegrands.
struct Slopes {
  VarianceSlope edge, smooth;
};

Slopes slopes_of(const std::string& sampler, const std::string& more) {
  const LaboratoryResults results = measured("samplers: [{ name: it, sampler: " + sampler +
                                             " }]\nspectrum: { points: 0 }\n" + more);
  const auto& slopes = results.samplers[0].slopes;
  return {slopes[0].value(), slopes[1].value()};
}

/// Checks that the whole interval lies between two bounds.
void check_between(const VarianceSlope& slope, double low, double high) {
  CAPTURE(slope.slope.value);
  CHECK(slope.slope.interval.low > low);
  CHECK(slope.slope.interval.high < high);
}

TEST_CASE("slopes of multi-jittered points, with permutations shared or not") {
  // Sets of few points gain more than the law of large ones when they double.
  const std::string range = "samples: { from: 6, to: 12 }\nrealizations: 400\n";
  const Slopes shared = slopes_of("multi_jittered", range);
  check_between(shared.edge, -1.7, -1.3);
  check_between(shared.smooth, -3.2, -2.8);
  const Slopes apart = slopes_of("{ type: multi_jittered, correlated: false }", range);
  check_between(apart.edge, -1.7, -1.3);
  check_between(apart.smooth, -2.2, -1.8);
}

TEST_CASE("slopes of pmj02") {
  const Slopes s = slopes_of("pmj02", "samples: { from: 4, to: 10 }\nrealizations: 400\n");
  check_between(s.edge, -1.65, -1.35);
  check_between(s.smooth, -3.2, -2.3);
}

TEST_CASE("slopes of pmj02bn") {
  // Preparations are expensive.
  const Slopes s =
      slopes_of("pmj02bn", "samples: { from: 4, to: 9 }\nrealizations: 400\npreparations: 12\n");
  check_between(s.edge, -1.7, -1.3);
  check_between(s.smooth, -3.3, -2.2);
}

TEST_CASE("the variance of independent points is the integrand's, over their number") {
  const LaboratoryResults results = measured(std::string(kTwo) +
                                             "samples: { from: 4, to: 6 }\n"
                                             "realizations: 4000\nspectrum: { points: 0 }\n");
  // The edge is 1 with probability 1/2. The squared Gaussian has the mean pi width^2.
  const double width = 0.15, mean = 2 * std::numbers::pi * width * width;
  const double expected[] = {0.25, std::numbers::pi * width * width - mean * mean};
  for (const std::size_t i : {0u, 1u}) {
    for (std::size_t n = 0; n < results.numbers.size(); ++n) {
      const VarianceEstimate& v = results.samplers[0].variances[i][n];
      CHECK(std::abs(std::log(v.value * results.numbers[n] / expected[i])) < 4 * v.log_error);
    }
  }
}

TEST_CASE("the variance of shifted points is the one that their spectrum foretells") {
  // The expected variance is the sum over frequencies of power times squared Fourier coefficient,
  // divided by the number of points. The coefficients of a Gaussian are (2 pi width^2) exp(-2 pi^2
  // width^2 f^2).
  const LaboratoryResults results = measured(std::string(kTwo) +
                                             "samples: { from: 2, to: 4 }\nrealizations: 4000\n"
                                             "spectrum: { points: 16, realizations: 2000, "
                                             "max_frequency: 8 }\n");
  const double width = 0.15, mean = 2 * std::numbers::pi * width * width;
  for (const SamplerResults& sampler : results.samplers) {
    double expected = 0;
    for (int y = -8; y <= 8; ++y) {
      for (int x = -8; x <= 8; ++x) {
        const double fall = 2 * std::numbers::pi * std::numbers::pi * width * width;
        const double c = mean * std::exp(-fall * (x * x + y * y));
        expected += *sampler.spectrum.pixel(8 + x, 8 - y) * c * c / 16;
      }
    }
    CHECK(sampler.variances[1].back().value == doctest::Approx(expected).epsilon(0.1));
  }
}

}  // namespace
}  // namespace pharos::laboratory
