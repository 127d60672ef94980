#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/gaussian_mixture.h>

namespace pharos::statistics {
namespace {

template <int D>
Vector<D> normal_point(RandomStream& random) {
  Vector<D> x;
  for (double& v : x) v = warp::normal_from_unit(random.next_1d() + 0x1p-25);
  return x;
}

using Eigen::MatrixXd;

// Decompositions take long to compile, so they are compiled once, for matrices of any size.

/// Returns an orthogonal matrix.
MatrixXd orthogonal(const MatrixXd& m) {
  return Eigen::HouseholderQR<MatrixXd>(m).householderQ();
}

/// Returns the normal density at a point with the difference `y` to the mean.
double normal_density(const MatrixXd& covariance, const MatrixXd& y) {
  const MatrixXd inverse = covariance.inverse();
  const double squared = (inverse * y).cwiseProduct(y).sum();
  return std::exp(-0.5 * squared) /
         std::sqrt(std::pow(2 * EIGEN_PI, y.rows()) * covariance.determinant());
}

/// Returns a needle or pancake at a random place. The ratio of its axes is at most `flat`.
template <int D>
Gaussian<D> random_gaussian(RandomStream& random, double flat) {
  Matrix<D> m;
  for (int i = 0; i < D; ++i) m.col(i) = normal_point<D>(random);
  const Matrix<D> axes = orthogonal(m);
  Vector<D> variances;
  for (double& v : variances) v = std::pow(flat, -2.0 * random.next_1d());
  const Matrix<D> covariance = axes * variances.asDiagonal() * axes.transpose();
  return {4 * normal_point<D>(random), 0.5 * (covariance + covariance.transpose())};
}

template <int D>
Vector<D> draw(const Gaussian<D>& g, RandomStream& random) {
  return g.mean + Eigen::LLT<Matrix<D>>(g.covariance).matrixL() * normal_point<D>(random);
}

template <int D>
WeightedPoints<D> draw(const GaussianMixture<D>& mixture, std::size_t count, bool weighted,
                       RandomStream& random) {
  WeightedPoints<D> points;
  for (std::size_t i = 0; i < count; ++i) {
    double u = random.next_1d();
    std::size_t k = 0;
    while (k + 1 < mixture.size() && u >= mixture.weights[k]) u -= mixture.weights[k++];
    points.add(draw(mixture.components[k], random), weighted ? 2 * random.next_1d() : 1);
  }
  return points;
}

template <int D>
GaussianMixture<D> random_mixture(std::size_t count, double flat, RandomStream& random) {
  GaussianMixture<D> mixture;
  for (std::size_t k = 0; k < count; ++k) {
    mixture.weights.push_back(1.0 / static_cast<double>(count));
    mixture.components.push_back(random_gaussian<D>(random, flat));
  }
  return mixture;
}

/// Returns random moments, as if they came from earlier points.
template <int D>
std::vector<Moments<D>> random_moments(std::size_t count, RandomStream& random) {
  std::vector<Moments<D>> all;
  for (std::size_t k = 0; k < count; ++k) {
    const Gaussian<D> g = random_gaussian<D>(random, 10);
    all.push_back(Moments<D>::of(200 * random.next_1d(), g.mean, g.covariance));
  }
  return all;
}

TEST_CASE_TEMPLATE("log densities are those of the formula", T, std::integral_constant<int, 3>,
                   std::integral_constant<int, 9>) {
  constexpr int D = T::value;
  RandomStream random(1);
  for (int i = 0; i < 100; ++i) {
    const Gaussian<D> g = random_gaussian<D>(random, 100);
    const Vector<D> x = draw(g, random);
    std::array<double, D> coordinates;
    for (int axis = 0; axis < D; ++axis) coordinates[axis] = x[axis];
    CHECK(std::exp(LogDensity<D>(g)(coordinates)) ==
          doctest::Approx(normal_density(g.covariance, x - g.mean)).epsilon(1e-8).scale(0));
  }
}

TEST_CASE("moments add up to means and covariances, and halves to the whole") {
  RandomStream random(2);
  const Gaussian<3> g = random_gaussian<3>(random, 50);
  const auto m = Moments<3>::of(7, g.mean, g.covariance);
  CHECK((m.mean() - g.mean).norm() < 1e-12);
  CHECK((m.covariance() - g.covariance).norm() < 1e-12);
  for (int i = 0; i < 20; ++i) {
    const Vector<3> direction = normal_point<3>(random).normalized();
    const auto parts = halves<3>(m, direction);
    const Moments<3> whole = parts[0] + parts[1];
    CHECK(whole.weight == doctest::Approx(7));
    CHECK((whole.mean() - g.mean).norm() < 1e-12);
    CHECK((whole.covariance() - g.covariance).norm() < 1e-12);
    const Matrix<3> left = parts[0].covariance();
    CHECK(direction.dot(left * direction) ==
          doctest::Approx(0.75 * direction.dot(g.covariance * direction)));
    CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(left).eigenvalues()[0] > 0);
  }
}

TEST_CASE("eigenvalues are raised to the floor and no others changed") {
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) {
    const Matrix<3> m = random_gaussian<3>(random, 100).covariance;
    const Matrix<3> raised = with_eigenvalues_above<3>(0.01, m);
    const Vector<3> before = Eigen::SelfAdjointEigenSolver<MatrixXd>(m).eigenvalues();
    const Vector<3> after = Eigen::SelfAdjointEigenSolver<MatrixXd>(raised).eigenvalues();
    for (int k = 0; k < 3; ++k) CHECK(after[k] == doctest::Approx(std::max(before[k], 0.01)));
  }
}

TEST_CASE_TEMPLATE("eigenvectors are orthonormal, in the order of their eigenvalues", T,
                   std::integral_constant<int, 3>, std::integral_constant<int, 9>) {
  constexpr int D = T::value;
  RandomStream random(4);
  for (int i = 0; i < 20; ++i) {
    const Matrix<D> m = random_gaussian<D>(random, 100).covariance;
    const Matrix<D> axes = eigenvectors<D>(m);
    CHECK((axes.transpose() * axes - Matrix<D>::Identity()).norm() < 1e-12);
    const Matrix<D> diagonal = axes.transpose() * m * axes;
    const Vector<D> values = diagonal.diagonal();
    CHECK((diagonal - Matrix<D>(values.asDiagonal())).norm() < 1e-12);
    CHECK(std::is_sorted(values.begin(), values.end()));
  }
}

TEST_CASE("the expectation of components that change is their part of the whole") {
  RandomStream random(8);
  const GaussianMixture<3> mixture = random_mixture<3>(5, 3, random);
  // There are more points than fit in one part.
  const WeightedPoints<3> points = draw(random_mixture<3>(4, 20, random), 5000, true, random);
  const Expectation<3> whole = expectation(mixture, points);
  const std::vector<std::vector<std::size_t>> choices{{1, 3}, {4}, {0, 1, 2, 3, 4}};
  for (const auto& changing : choices) {
    const Expectation<3> part = MaskedExpectation<3>(mixture, points, changing)(mixture);
    CHECK(part.log_likelihood == doctest::Approx(whole.log_likelihood).epsilon(1e-12));
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      const bool changes = std::find(changing.begin(), changing.end(), k) != changing.end();
      const Moments<3> expected = changes ? whole.moments[k] : Moments<3>{};
      CHECK(part.moments[k].weight == doctest::Approx(expected.weight).epsilon(1e-10));
      CHECK((part.moments[k].first - expected.first).norm() <= 1e-9 * (1 + expected.first.norm()));
      CHECK((part.moments[k].second - expected.second).norm() <=
            1e-9 * (1 + expected.second.norm()));
    }
  }
}

TEST_CASE("a fit of some components takes the same steps at once as one by one") {
  RandomStream random(9);
  GaussianMixture<3> at_once = random_mixture<3>(5, 3, random), one_by_one = at_once;
  const WeightedPoints<3> points = draw(random_mixture<3>(4, 20, random), 700, true, random);
  const std::vector<std::size_t> changing{0, 2};
  MixtureFit<3> fit{.prior = {0.01, 0.2, 0.5}, .changing = changing, .tolerance = -1e9};
  constexpr int kSteps = 6;
  fit.most_iterations = kSteps;
  const FitResult<3> all = fit_mixture(at_once, points, fit);
  CHECK(all.iterations == kSteps);
  fit.most_iterations = 1;
  FitResult<3> last;
  for (int i = 0; i < kSteps; ++i) last = fit_mixture(one_by_one, points, fit);
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(at_once.weights[k] == doctest::Approx(one_by_one.weights[k]).epsilon(1e-10));
    CHECK((at_once.components[k].mean - one_by_one.components[k].mean).norm() < 1e-9);
    CHECK(all.seen[k].weight == doctest::Approx(last.seen[k].weight).epsilon(1e-9));
  }
}

TEST_CASE_TEMPLATE("a fit never lowers its objective", T, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  constexpr int D = T::value;
  RandomStream random(4);
  for (int round = 0; round < 12; ++round) {
    const bool masked = round % 3 == 2;
    GaussianMixture<D> mixture = random_mixture<D>(5, 3, random);
    const WeightedPoints<D> points =
        draw(random_mixture<D>(4, 20, random), round % 2 == 0 ? 700 : 12, true, random);
    const std::vector<Moments<D>> frozen = random_moments<D>(5, random);
    const std::vector<double> floors(5, round % 4 == 0 ? 0.05 : 0.0);
    const std::vector<std::size_t> changing{1, 3};
    MixtureFit<D> fit{.prior = {0.01, 0.2, 0.5}, .floors = floors, .most_iterations = 1};
    if (round % 2 == 1) fit.frozen = frozen;
    if (masked) fit.changing = changing;
    for (auto& g : mixture.components) {
      g.covariance = with_eigenvalues_above<D>(floors[0], g.covariance);
    }
    const GaussianMixture<D> before = mixture;
    double last = -std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 30; ++iteration) {
      const double now = objective(mixture, expectation(mixture, points).log_likelihood, fit);
      CHECK(now >= last - 1e-9 * std::abs(now));
      last = now;
      fit_mixture(mixture, points, fit);
    }
    double total = 0;
    for (const double w : mixture.weights) total += w;
    CHECK(total == doctest::Approx(1).epsilon(1e-12));
    if (!masked) continue;
    for (const std::size_t k : {0u, 2u, 4u}) {
      CHECK(mixture.weights[k] == before.weights[k]);
      CHECK(mixture.components[k].mean == before.components[k].mean);
    }
  }
}

TEST_CASE("a fit recovers the mixture that points were drawn from") {
  RandomStream random(5);
  GaussianMixture<3> truth;
  truth.weights = {0.5, 0.3, 0.2};
  const Vector<3> means[3] = {{0, 0, 0}, {3, 0, 1}, {-2, 4, 0}};
  const Vector<3> deviations[3] = {{1, 0.1, 0.4}, {0.02, 0.5, 0.5}, {0.3, 0.3, 0.3}};
  for (int k = 0; k < 3; ++k) {
    truth.components.push_back({means[k], deviations[k].cwiseAbs2().asDiagonal()});
  }
  const WeightedPoints<3> points = draw(truth, 40'000, false, random);
  GaussianMixture<3> mixture = truth;
  mixture.weights = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  for (auto& g : mixture.components) {
    g.mean += 0.8 * normal_point<3>(random);
    g.covariance = Matrix<3>::Identity();
  }
  fit_mixture(mixture, points, MixtureFit<3>{.most_iterations = 300, .tolerance = 1e-8});
  for (int k = 0; k < 3; ++k) {
    const double count = 40'000 * truth.weights[k];
    CHECK(mixture.weights[k] == doctest::Approx(truth.weights[k]).epsilon(0.03));
    const auto& g = mixture.components[k];
    for (int axis = 0; axis < 3; ++axis) {
      const double error = deviations[k][axis] / std::sqrt(count);
      CHECK(std::abs(g.mean[axis] - means[k][axis]) < 5 * error);
      CHECK(std::sqrt(g.covariance(axis, axis)) ==
            doctest::Approx(deviations[k][axis]).epsilon(0.05).scale(0));
    }
  }
}

TEST_CASE("the prior pulls what few points say towards a ball") {
  const Gaussian<3> needle{Vector<3>::Zero(), Vector<3>{1, 1e-4, 1e-4}.asDiagonal()};
  const MixturePrior prior{.counts = 0.01, .strength = 0.2, .variance = 0.3};
  const auto one = Moments<3>::of(0.001, needle.mean, needle.covariance);
  const auto many = Moments<3>::of(1e6, needle.mean, needle.covariance);
  const Matrix<3> ball = 0.3 * Matrix<3>::Identity();
  CHECK((map_covariance(one, prior, 0) - ball).norm() < 0.01);
  CHECK((map_covariance(many, prior, 0) - needle.covariance).norm() < 1e-6);
}

TEST_CASE("an expectation is the same for any number of threads") {
  RandomStream random(7);
  const GaussianMixture<3> mixture = random_mixture<3>(6, 10, random);
  const WeightedPoints<3> points = draw(mixture, 30'001, true, random);
  const auto with_threads = [&](std::size_t threads) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return expectation(mixture, points);
  };
  const Expectation<3> one = with_threads(1), two = with_threads(2);
  CHECK(one.log_likelihood == two.log_likelihood);
  double weight = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK(one.moments[k].weight == two.moments[k].weight);
    CHECK(one.moments[k].second == two.moments[k].second);
    weight += one.moments[k].weight;
  }
  double expected = 0;
  for (std::size_t i = 0; i < points.size(); ++i) expected += points.weight(i);
  CHECK(weight == doctest::Approx(expected).epsilon(1e-12));
}

TEST_CASE("no point is too far away to belong to a component") {
  GaussianMixture<3> mixture;
  mixture.weights = {0.5, 0.5};
  mixture.components = {{Vector<3>{0, 0, 0}, 1e-6 * Matrix<3>::Identity()},
                        {Vector<3>{1, 0, 0}, 1e-6 * Matrix<3>::Identity()}};
  WeightedPoints<3> points;
  points.add({1000, 0, 0}, 1);
  const Expectation<3> e = expectation(mixture, points);
  CHECK(e.moments[1].weight == 1);
  CHECK(std::isfinite(e.log_likelihood));
}

}  // namespace
}  // namespace pharos::statistics
