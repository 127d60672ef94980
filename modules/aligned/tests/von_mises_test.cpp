#include "../von_mises.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

namespace pharos::aligned {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;
constexpr double kFloor = 1e-2;
constexpr int kNoAxes = -1;  ///< a width that includes all directions

double unscaled(int direction, double mean, double kappa) {
  return std::exp(kappa * (std::cos(2 * kRadians * (direction - mean)) - 1));
}

/// Returns a mixture of two distributions. The first has the weight `share`, and the second has the
/// rest.
DirectionHistogram mixture(double share, VonMises first, VonMises second = {}) {
  DirectionHistogram histogram{};
  double sum_first = 0, sum_second = 0;
  for (int k = 0; k < kDirections; ++k) {
    sum_first += unscaled(k, first.mean, first.kappa);
    sum_second += unscaled(k, second.mean, second.kappa);
  }
  for (int k = 0; k < kDirections; ++k) {
    histogram[static_cast<std::size_t>(k)] =
        share * unscaled(k, first.mean, first.kappa) / sum_first +
        (1 - share) * unscaled(k, second.mean, second.kappa) / sum_second;
  }
  return histogram;
}

/// Returns a histogram without a particular shape and with empty bins.
DirectionHistogram rough_histogram(std::uint64_t seed) {
  RandomStream random(seed);
  DirectionHistogram histogram{};
  for (double& bin : histogram) bin = std::max(0.0, random.next_1d() - 0.3);
  return histogram;
}

/// Computes D(q || p) by its definition, over the directions more than `width` degrees away from
/// the axes.
double divergence_of(const VonMises& q, const DirectionHistogram& histogram, int width) {
  double q_sum = 0, p_sum = 0;
  for (int k = 0; k < kDirections; ++k) {
    if (degrees_from_axis(k) <= width) continue;
    q_sum += unscaled(k, q.mean, q.kappa);
    p_sum += histogram[static_cast<std::size_t>(k)];
  }
  double divergence = 0;
  for (int k = 0; k < kDirections; ++k) {
    if (degrees_from_axis(k) <= width) continue;
    const double q_k = unscaled(k, q.mean, q.kappa) / q_sum;
    const double p_k =
        std::max(histogram[static_cast<std::size_t>(k)] / p_sum, kFloor / kDirections);
    if (q_k > 0) divergence += q_k * std::log(q_k / p_k);
  }
  return divergence;
}

}  // namespace

TEST_CASE("von Mises: the divergence is that of the definition") {
  for (const int width : {kNoAxes, 3}) {
    const DirectionHistogram histogram = rough_histogram(2);
    const DirectionDistribution p(histogram, width, kFloor);
    for (const VonMises q : {VonMises{40, 50}, {3, 50}, {177.5, 5}, {90, 0.5}}) {
      CHECK(p.divergence(q) == doctest::Approx(divergence_of(q, histogram, width)).epsilon(1e-9));
    }
  }
}

TEST_CASE("von Mises: of a distribution from itself there is none") {
  const DirectionDistribution p(mixture(1, {70, 20}), kNoAxes, 1e-30);
  CHECK(std::abs(p.divergence({70, 20})) < 1e-12);
  CHECK(p.divergence({72, 20}) > 1e-3);
  // The divergence from a uniform distribution, with doubled angles as in eq. 18: kappa I1/I0 -
  // log(I0).
  const DirectionDistribution uniform(mixture(1, {0, 1e-9}), kNoAxes, kFloor);
  const double i0 = std::cyl_bessel_i(0.0, 20.0), i1 = std::cyl_bessel_i(1.0, 20.0);
  CHECK(uniform.divergence({70, 20}) == doctest::Approx(20 * i1 / i0 - std::log(i0)).epsilon(1e-6));
}

TEST_CASE("von Mises: gradients by finite differences") {
  for (const int width : {kNoAxes, 3}) {
    const DirectionDistribution p(rough_histogram(5), width, kFloor);
    for (const VonMises q : {VonMises{33, 50}, {92, 12}, {171, 3}}) {
      constexpr double kStep = 1e-4;
      const auto found = p.gradient(q);
      const double mean =
          (p.divergence({q.mean + kStep, q.kappa}) - p.divergence({q.mean - kStep, q.kappa})) /
          (2 * kStep);
      const double kappa =
          (p.divergence({q.mean, q.kappa + kStep}) - p.divergence({q.mean, q.kappa - kStep})) /
          (2 * kStep);
      CHECK(found.mean == doctest::Approx(mean).epsilon(1e-5));
      CHECK(found.kappa == doctest::Approx(kappa).epsilon(1e-5));
    }
  }
}

TEST_CASE("von Mises: the best mean is that of a search through all") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const DirectionHistogram histogram = rough_histogram(seed);
    const DirectionDistribution p(histogram, 3, kFloor);
    int best = 0;
    for (int k = 0; k < kDirections; ++k) {
      const auto at = [&](int mean) {
        return divergence_of({static_cast<double>(mean), 50}, histogram, 3);
      };
      if (at(k) < at(best)) best = k;
    }
    CHECK(best_mean(p, 50, 17, 90) == best);
    const int near = best_mean(p, 50, 60, 5);
    CHECK(degrees_between(near, 60) <= 5);
    for (int k = 55; k <= 65; ++k) {
      CHECK(p.divergence({double(near), 50}) <= p.divergence({double(k), 50}));
    }
  }
}

TEST_CASE("von Mises: one mode is found beside another, without and with its concentration") {
  // Figure 4 of the paper, with axial directions: half its angles.
  const DirectionDistribution p(mixture(0.75, {45, 10}, {135, 30}), kNoAxes, 1e-6);
  CHECK(degrees_between(best_mean(p, 50, 50, 10), 45) <= 1);
  CHECK(degrees_between(best_mean(p, 50, 130, 10), 135) <= 1);
  const VonMises first = descend(p, {52, 20}), second = descend(p, {128, 20});
  CHECK(std::abs(first.mean - 45) < 1);
  CHECK(first.kappa == doctest::Approx(10).epsilon(0.1));
  CHECK(std::abs(second.mean - 135) < 1);
  CHECK(second.kappa == doctest::Approx(30).epsilon(0.1));
}

TEST_CASE("von Mises: descent finds the parameters of a single mode") {
  const VonMises found =
      descend(DirectionDistribution(mixture(1, {172, 25}), kNoAxes, 1e-12), {4, 60});
  CHECK(std::abs(found.mean - 172) < 0.05);
  CHECK(found.kappa == doctest::Approx(25).epsilon(0.01));
}

TEST_CASE("direction distributions: shares, masses and axes") {
  DirectionHistogram histogram{};
  histogram[0] = 6, histogram[2] = 2, histogram[40] = 3, histogram[42] = 1;
  const DirectionDistribution p(histogram, 3, kFloor);
  CHECK(p.share(0) == 0);
  CHECK(p.share(2) == 0);
  CHECK(p.share(40) == doctest::Approx(0.75));
  CHECK(p.mass(41, 1) == doctest::Approx(4.0 / 12));
  CHECK(p.mass(38, 2) == doctest::Approx(3.0 / 12));
  CHECK_FALSE(p.empty());
  histogram[40] = histogram[42] = 0;
  CHECK(DirectionDistribution(histogram, 3, kFloor).empty());
  CHECK(DirectionDistribution({}, 3, kFloor).empty());
}

}  // namespace pharos::aligned
