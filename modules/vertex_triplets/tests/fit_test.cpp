#include <cmath>

#include <doctest/doctest.h>

#include "../clustering.h"
#include "test_gaussians.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;

template <int D>
Points<D> points_of(const Mixture<D>& mixture, int count, std::uint64_t seed,
                    bool weighted = false) {
  Points<D> points;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    double u = random.next_1d();
    std::size_t k = 0;
    while (k + 1 < mixture.size() && u >= mixture.weights[k]) u -= mixture.weights[k++];
    const Vector<D> x = point_of(mixture.components[k], random);
    std::array<float, D> f;
    for (int axis = 0; axis < D; ++axis) f[axis] = static_cast<float>(x[axis]);
    points.add(f, weighted ? 0.25f + 2 * random.next_1d() : 1.0f);
  }
  return points;
}

template <int D>
Mixture<D> any_mixture(int count, double apart, std::uint64_t seed) {
  Mixture<D> mixture;
  RandomStream random(seed);
  for (int k = 0; k < count; ++k) {
    mixture.weights.push_back(1.0 / count);
    mixture.components.push_back(any_gaussian<D>(random, 0.3, 0.3));
    mixture.components.back().mean = apart * normal_vector<D>(random);
  }
  return mixture;
}

/// Returns the mean log-likelihood, computed point by point in double precision.
template <int D>
double log_likelihood(const Mixture<D>& mixture, const Points<D>& points) {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& from = points.registers()[i / 8];
    Vector<D> x;
    for (int axis = 0; axis < D; ++axis) x[axis] = from.x[axis][i % 8];
    double p = 0;
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      p += mixture.weights[k] * density(mixture.components[k], x);
    }
    sum += from.weight[i % 8] * std::log(p);
    weights += from.weight[i % 8];
  }
  return sum / weights;
}

TEST_CASE_TEMPLATE("E step: as point by point in double precision", D,
                   std::integral_constant<int, 3>, std::integral_constant<int, 6>,
                   std::integral_constant<int, 9>) {
  constexpr int kD = D::value;
  const Mixture<kD> mixture = any_mixture<kD>(5, 0.4, 1);
  const Points<kD> points = points_of(mixture, 203, 2, true);
  const Expectation<kD> found = expectation(mixture, points);
  CHECK(found.log_likelihood == doctest::Approx(log_likelihood(mixture, points)).epsilon(1e-5));
  double weight = 0, total = 0;
  for (const Sums<kD>& sums : found.sums) weight += sums.weight;
  for (const auto& r : points.registers()) total += sum(r.weight);
  CHECK(weight == doctest::Approx(total).epsilon(1e-5));
}

TEST_CASE_TEMPLATE("EM: without regularization no step is for the worse", D,
                   std::integral_constant<int, 3>, std::integral_constant<int, 6>,
                   std::integral_constant<int, 9>) {
  constexpr int kD = D::value;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Points<kD> points = points_of(any_mixture<kD>(6, 0.5, seed), 3000, 100 + seed, true);
    // Starts near the true mixture, so that no component collapses to a few points.
    Mixture<kD> mixture = any_mixture<kD>(6, 0.5, seed);
    RandomStream random(50 + seed);
    for (auto& g : mixture.components) {
      g.mean += 0.2 * normal_vector<kD>(random);
      g.covariance += 0.05 * Matrix<kD>::Identity();
    }
    const double start = expectation(mixture, points).log_likelihood;
    double last = start;
    for (int i = 0; i < 30; ++i) {
      const Expectation<kD> found = expectation(mixture, points);
      CHECK(found.log_likelihood >= last - 1e-5);
      last = found.log_likelihood;
      mixture = maximization(mixture, found, {.is_on = false});
    }
    CHECK(last > start + 0.1);
  }
}

TEST_CASE("EM: with regularization the best mixture on the way is kept") {
  FitSettings settings;
  settings.tolerance = 0;
  bool some_step_was_worse = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Points<9> points = points_of(any_mixture<9>(4, 1, seed), 40, 100 + seed, true);
    const Mixture<9> start = any_mixture<9>(4, 1, 50 + seed);
    double best = -1e30;
    Mixture<9> mixture = start;
    for (int i = 0; i < settings.most_iterations; ++i) {
      const Expectation<9> found = expectation(mixture, points);
      some_step_was_worse |= found.log_likelihood < best - 1e-3;
      best = std::max(best, found.log_likelihood);
      mixture = maximization(mixture, found, settings.regularization);
    }
    const Fit<9> kept = fit(start, points, settings);
    CHECK(kept.iterations <= settings.most_iterations);
    CHECK(kept.log_likelihood >= best - 1e-6);
    CHECK(expectation(kept.mixture, points).log_likelihood == doctest::Approx(kept.log_likelihood));
  }
  CHECK(some_step_was_worse);
}

TEST_CASE("EM: ends when the likelihood changes by less than a thousandth") {
  const Points<9> points = points_of(any_mixture<9>(3, 2, 1), 2000, 2);
  const Fit<9> found = fit(any_mixture<9>(3, 2, 1), points, {});
  CHECK(found.iterations < 10);
  CHECK(fit(any_mixture<9>(3, 2, 1), points, {.tolerance = 0}).iterations == 50);
}

TEST_CASE_TEMPLATE("AIC finds as many components as there are, well apart", D,
                   std::integral_constant<int, 3>, std::integral_constant<int, 6>,
                   std::integral_constant<int, 9>) {
  constexpr int kD = D::value;
  for (const int count : {1, 2, 3, 5, 8}) {
    const Mixture<kD> truth = any_mixture<kD>(count, 8, 7 + count);
    const Points<kD> points = points_of(truth, 400 * count, 13);
    const Mixture<kD> found = fit_clusters(points, {.most_components = 128});
    CAPTURE(count);
    CHECK(static_cast<int>(found.size()) == count);
    CHECK(log_likelihood(found, points) > log_likelihood(truth, points) - 0.05);
  }
}

TEST_CASE("clusters: no more than allowed, none of nothing") {
  const Points<9> points = points_of(any_mixture<9>(8, 8, 3), 4000, 4);
  CHECK(fit_clusters(points, {.most_components = 5}).size() == 5);
  CHECK(fit_clusters(points, {.most_components = 1}).size() == 1);
  Points<9> same;
  for (int i = 0; i < 100; ++i) same.add({1, 2, 3, 4, 5, 6, 7, 8, 9}, 1);
  const Mixture<9> one = fit_clusters(same, {});
  REQUIRE(one.size() == 1);
  CHECK(one.components[0].mean[8] == doctest::Approx(9));
  Points<9> single;
  single.add({1, 2, 3, 4, 5, 6, 7, 8, 9}, 1e-9f);
  const Mixture<9> round = fit_clusters(single, {});
  REQUIRE(round.size() == 1);
  CHECK(round.components[0].covariance.isApprox(0.01 * Matrix<9>::Identity(), 1e-6));
}

TEST_CASE("regularization: shares by the effective number of points (eq. 39 to 44, corrected)") {
  RandomStream random(1);
  const Matrix<9> sample = any_gaussian<9>(random, 0.5).covariance;
  const Matrix<9> blocks = isotropic_blocks<9>(sample);
  const Regularization rule;
  CHECK(regularized<9>(sample, 1, rule).isApprox(0.01 * Matrix<9>::Identity()));
  CHECK(regularized<9>(sample, 4, rule).isApprox(0.25 * sample + 0.75 * blocks));
  const double share = 99.0 / 108;
  CHECK(regularized<9>(sample, 100, rule).isApprox(share * sample + (1 - share) * blocks));
  const Matrix<3> flat = Matrix<3>::Zero();
  CHECK(regularized<3>(flat, 1e9, rule).isApprox(1e-8 * Matrix<3>::Identity()));
}

TEST_CASE("regularization: continuous in the number of points, positive definite") {
  RandomStream random(2);
  for (int i = 0; i < 20; ++i) {
    Matrix<9> sample = any_gaussian<9>(random, 0.5).covariance;
    if (i % 2 == 0) {  // the covariance of two points
      const Vector<9> d = normal_vector<9>(random);
      sample = d * d.transpose();
    }
    Matrix<9> last = regularized<9>(sample, 1, {});
    for (double count = 1; count < 40; count += 0.01) {
      const Matrix<9> next = regularized<9>(sample, count, {});
      CHECK((next - last).norm() < 0.02 * (sample.norm() + 0.03));
      CHECK(is_positive_definite(next));
      last = next;
    }
  }
}

}  // namespace
}  // namespace pharos::vertex_triplets
