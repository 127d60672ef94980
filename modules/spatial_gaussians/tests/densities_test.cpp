#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <doctest/doctest.h>

#include <pharos/core/warp.h>
#include <pharos/guiding/toolkit/ray_integrals.h>
#include <pharos/guiding/toolkit/seen_gaussian.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>
#include <pharos/statistics/von_mises_fisher.h>

#include "../seen_mixture.h"
#include "test_gaussians.h"

namespace pharos::spatial_gaussians {
namespace {

using namespace testing;
using Matrix3l = Eigen::Matrix<long double, 3, 3>;
using Vector3l = Eigen::Matrix<long double, 3, 1>;

/// Returns the integral that defines p0 (eq. 1) by quadrature: r^2 N(r omega - mu; 0, Sigma) over
/// r > 0, with the covariance itself.
long double integral_over_ray(const SpatialGaussian& g, Point3 origin, Vec3 direction) {
  Matrix3l l = Matrix3l::Zero();
  l << g.cholesky[0], 0, 0, g.cholesky[1], g.cholesky[2], 0, g.cholesky[3], g.cholesky[4],
      g.cholesky[5];
  const Vector3l mu(static_cast<long double>(g.mean.x) - origin.x,
                    static_cast<long double>(g.mean.y) - origin.y,
                    static_cast<long double>(g.mean.z) - origin.z);
  const Vector3l omega(direction.x, direction.y, direction.z);
  const auto squared = [&](long double r) {
    return l.triangularView<Eigen::Lower>().solve(Vector3l(r * omega - mu)).squaredNorm();
  };
  // The range where the integrand is not negligible: around the closest approach, r > 0.
  const Vector3l v = l.triangularView<Eigen::Lower>().solve(omega);
  const Vector3l m = l.triangularView<Eigen::Lower>().solve(mu);
  const long double unit = 1 / v.norm(), u = v.dot(m) * unit;
  const long double end = u + (u > 0 ? 10 : std::sqrt(u * u + 100)), begin = std::max(0.0L, u - 10);
  constexpr int kPanels = 3;
  long double sum = 0;
  for (int i = 0; i < kPanels; ++i) {
    const auto at = [&](int edge) { return unit * (begin + (end - begin) * edge / kPanels); };
    const auto f = [&](long double r) { return r * r * std::exp(-0.5L * squared(r)); };
    sum += boost::math::quadrature::gauss<long double, 30>::integrate(f, at(i), at(i + 1));
  }
  return sum / (std::pow(2 * EIGEN_PI, 1.5L) * l.diagonal().prod());
}

/// A Gaussian, the origin from which it is seen, and a direction.
struct Case {
  SpatialGaussian gaussian;
  Point3 origin;
  Vec3 direction;
};

/// Returns a random case: a ball, needle or pancake of any size, seen from within, from nearby or
/// from afar. Most directions hit the Gaussian, some pass it or point away from it.
Case random_case(RandomStream& random) {
  const double size = log_uniform(1e-3, 1e3, random);
  Vec3 deviations;
  for (int axis = 0; axis < 3; ++axis) {
    const double flat = random.next_1d() < 0.5f ? 1 : log_uniform(1e-3, 1, random);
    deviations[axis] = static_cast<float>(size * flat);
  }
  const Point3 origin = static_cast<float>(size) * any_direction(random);
  const float u = random.next_1d();
  const double distance = u < 0.1f ? 0 : log_uniform(1e-3, 100, random);
  const Point3 mean = origin + static_cast<float>(distance * size) * any_direction(random);
  Case c{oriented_gaussian(mean, deviations, random), origin, {}};
  c.direction = random.next_1d() < 0.2f ? any_direction(random)
                                        : normalize(point_of(c.gaussian, origin, random));
  if (random.next_1d() < 0.1f) c.direction = -c.direction;
  return c;
}

float seen_density(const Case& c, Technique technique, Arena& arena) {
  arena.reset();
  const SeenMixture* seen = SeenMixture::make({&c.gaussian, 1}, c.origin, {}, technique, arena);
  return seen == nullptr ? 0 : seen->density(c.direction);
}

/// Smaller densities are not compared, because they are near the limits of floats.
constexpr double kLeast = 1e-30;

TEST_CASE("the moment of a ray is its integral and meets its series") {
  const auto integrand = [](double x, double r) { return r * r * std::exp(-0.5 * r * r - x * r); };
  for (double x = 0; x < 60; x += 0.217) {
    const auto f = [&](double r) { return integrand(x, r); };
    const double end = std::sqrt(x * x + 100) - x;
    const double expected = boost::math::quadrature::gauss<double, 60>::integrate(f, 0.0, end / 2) +
                            boost::math::quadrature::gauss<double, 60>::integrate(f, end / 2, end);
    CHECK(ray_moment(x) == doctest::Approx(expected).epsilon(1e-8).scale(0));
    const Float8 single = ray_moment_over_root_2_pi(all8(static_cast<float>(x)));
    CHECK(single[3] == doctest::Approx(expected * kOverRoot2Pi).epsilon(2e-6).scale(0));
  }
}

TEST_CASE("p0 and p1 are the integrals that define them, in double precision") {
  RandomStream random(1);
  double worst0 = 0, worst1 = 0;
  int compared = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Case c = random_case(random);
    const auto ahead = static_cast<double>(integral_over_ray(c.gaussian, c.origin, c.direction));
    const auto behind = static_cast<double>(integral_over_ray(c.gaussian, c.origin, -c.direction));
    if (!(ahead > 1e-200)) continue;
    ++compared;
    const double p0 = exact_density(c.gaussian, c.origin, c.direction);
    const double p1 = flipped_density(c.gaussian, c.origin, c.direction);
    worst0 = std::max(worst0, std::abs(p0 / ahead - 1));
    const Vec3 aim = c.gaussian.mean - c.origin;
    const double side = dot(aim, c.direction);
    if (std::abs(side) < 1e-5 * length(aim)) continue;
    const double expected = c.gaussian.mean == c.origin ? ahead : side > 0 ? ahead + behind : 0;
    worst1 = std::max(worst1, expected == 0 ? p1 : std::abs(p1 / expected - 1));
  }
  CHECK(compared > 80'000);
  CHECK(worst0 < 1e-6);
  CHECK(worst1 < 1e-6);
  MESSAGE("largest relative errors: p0 ", worst0, ", p1 ", worst1);
}

TEST_CASE("what guiders compute in floats is what the formulas say") {
  RandomStream random(2);
  Arena arena;
  for (const Technique technique : {Technique::exact, Technique::flipped, Technique::plane}) {
    CAPTURE(static_cast<int>(technique));
    const bool is_plane = technique == Technique::plane;
    std::vector<double> errors;
    for (int i = 0; i < 100'000; ++i) {
      const Case c = random_case(random);
      const auto density = technique == Technique::exact     ? exact_density
                           : technique == Technique::flipped ? flipped_density
                                                             : projected_density;
      const double expected = density(c.gaussian, c.origin, c.direction);
      const double value = seen_density(c, technique, arena);
      const Vec3 aim = c.gaussian.mean - c.origin;
      const bool on_edge = std::abs(dot(aim, c.direction)) < 1e-5f * length(aim);
      if (technique != Technique::exact && on_edge) continue;
      if (expected > kLeast && expected < 1e30) errors.push_back(std::abs(value / expected - 1));
      if (expected == 0) CHECK(value == 0);
      CHECK(std::isfinite(value));
    }
    CHECK(errors.size() > 50'000);
    std::sort(errors.begin(), errors.end());
    CHECK(errors.back() < (is_plane ? 2e-3 : 1e-3));
    CHECK(errors[errors.size() * 99 / 100] < 1e-4);
    MESSAGE("relative errors in float: at 99 % ", errors[errors.size() * 99 / 100], ", largest ",
            errors.back());
  }
}

/// Returns a Gaussian at a distance from kOrigin of so many (largest) standard deviations.
SpatialGaussian lobe_at(float distance, RandomStream& random) {
  return oriented_gaussian(Point3{0.3f, -0.2f, 0.5f} + distance * any_direction(random),
                           {1, 0.5f, 0.3f}, random);
}
constexpr Point3 kOrigin{0.3f, -0.2f, 0.5f};

TEST_CASE("densities integrate to one over the sphere") {
  RandomStream random(3);
  for (const float distance : {0.0f, 0.3f, 1.0f, 2.0f, 4.0f, 10.0f}) {
    const SpatialGaussian g = lobe_at(distance, random);
    CAPTURE(distance);
    const auto integral = [&](auto density) {
      return statistics::integrate_sphere([&](Vec3 w) { return density(g, kOrigin, w); },
                                          {.tolerance = 2e-4}, 24, 48)
          .value;
    };
    CHECK(integral(exact_density) == doctest::Approx(1).epsilon(1e-4));
    CHECK(integral(flipped_density) == doctest::Approx(1).epsilon(3e-4));
    if (distance > 0) CHECK(integral(projected_density) == doctest::Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("p1 is p0 of both directions of a line, and even") {
  RandomStream random(4);
  for (int i = 0; i < 200; ++i) {
    const SpatialGaussian g = lobe_at(3 * random.next_1d(), random);
    const Vec3 w = any_direction(random);
    const double both = exact_density(g, kOrigin, w) + exact_density(g, kOrigin, -w);
    const double flipped = flipped_density(g, kOrigin, w) + flipped_density(g, kOrigin, -w);
    CHECK(flipped == doctest::Approx(both).epsilon(1e-9).scale(0));
  }
}

/// Returns the total variation distance between two densities.
template <class A, class B>
double variation(const A& a, const B& b) {
  return 0.5 * statistics::integrate_sphere([&](Vec3 w) { return std::abs(a(w) - b(w)); },
                                            {.tolerance = 1e-3}, 24, 48)
                   .value;
}

TEST_CASE("projection and the exact density are the closer the farther the lobe") {
  RandomStream random(5);
  // The expected values were computed by quadrature for one orientation. Means over many
  // orientations are close to them.
  const std::pair<float, double> distances[] = {{1, 0.28}, {2, 0.17}, {4, 0.07}, {10, 0.04}};
  double last = 1;
  for (const auto& entry : distances) {
    const auto distance = entry.first;
    constexpr int kLobes = 16;
    double mean = 0;
    for (int i = 0; i < kLobes; ++i) {
      const SpatialGaussian g = lobe_at(distance, random);
      mean += variation([&](Vec3 w) { return exact_density(g, kOrigin, w); },
                        [&](Vec3 w) { return projected_density(g, kOrigin, w); }) /
              kLobes;
    }
    CAPTURE(distance);
    CHECK(mean < last);
    CHECK(std::abs(mean - entry.second) < 0.04);
    last = mean;
  }
}

/// Checks the samples of a seen mixture against its density.
void check_fit(const SeenMixture& seen, std::uint64_t seed) {
  const auto draw = [&](RandomStream& random) {
    const float choice = random.next_1d();
    const Vec2 u = random.next_2d();
    return seen.sample(choice, u, random.next_1d());
  };
  const auto fit = statistics::fit_direction_density(
      draw, [&](Vec3 w) { return double{seen.density(w)}; },
      {.draws = 100'000, .seed = seed, .cells = 100, .quadrature_tolerance = 1e-3});
  CHECK(fit.chi_square.p_value > 1e-4);
  CHECK(fit.is_density(2e-3));
  CHECK(fit.integral == doctest::Approx(1).epsilon(3e-3));
}

TEST_CASE("draws follow their density: single lobes at any distance") {
  RandomStream random(6);
  Arena arena;
  for (const float distance : {0.0f, 0.5f, 1.0f, 2.0f, 4.0f, 10.0f}) {
    for (const Technique technique : {Technique::exact, Technique::flipped, Technique::plane}) {
      CAPTURE(distance);
      CAPTURE(static_cast<int>(technique));
      const SpatialGaussian g = lobe_at(distance, random);
      arena.reset();
      const SeenMixture* seen = SeenMixture::make({&g, 1}, kOrigin, {}, technique, arena);
      REQUIRE((seen != nullptr) == (distance > 0 || technique != Technique::plane));
      if (seen != nullptr) check_fit(*seen, 7);
    }
  }
}

/// Returns a mixture of balls, needles and pancakes around the origin and far from it.
std::vector<SpatialGaussian> mixed_components(std::size_t count, RandomStream& random) {
  std::vector<SpatialGaussian> all;
  float total = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 deviations{1, static_cast<float>(log_uniform(0.05, 1, random)),
                          static_cast<float>(log_uniform(0.05, 1, random))};
    all.push_back(oriented_gaussian(
        kOrigin + static_cast<float>(log_uniform(0.1, 20, random)) * any_direction(random),
        deviations, random));
    all.back().weight = 0.1f + random.next_1d();
    total += all.back().weight;
  }
  for (SpatialGaussian& g : all) g.weight /= total;
  return all;
}

TEST_CASE("draws follow their density: mixtures, weighted by cosines or not") {
  RandomStream random(8);
  Arena arena;
  for (const std::size_t count : {2u, 8u, 13u}) {
    const std::vector<SpatialGaussian> components = mixed_components(count, random);
    for (const Technique technique : {Technique::exact, Technique::flipped, Technique::plane}) {
      for (const bool both_sides : {false, true}) {
        CAPTURE(count);
        CAPTURE(static_cast<int>(technique));
        arena.reset();
        const FactorRule rule{any_direction(random), both_sides, 0.01f};
        const SeenMixture* seen = SeenMixture::make(components, kOrigin, rule, technique, arena);
        REQUIRE(seen != nullptr);
        check_fit(*seen, 9);
      }
    }
  }
}

TEST_CASE("draws follow their density: mixtures, weighted by lobes of the BSDF") {
  RandomStream random(12);
  Arena arena;
  for (const std::size_t count : {3u, 13u}) {
    const std::vector<SpatialGaussian> components = mixed_components(count, random);
    const ScatteringLobe lobes[] = {{any_direction(random), 50, 2}, {any_direction(random), 1, 1}};
    const FactorRule rule{.lobes = lobes};
    const SeenMixture* seen = SeenMixture::make(components, kOrigin, rule, Technique::exact, arena);
    REQUIRE(seen != nullptr);
    check_fit(*seen, 9);
  }
}

TEST_CASE("weights by lobes are the integrals of the products, for small components") {
  // Balls at different distances, whose directions resemble von Mises-Fisher lobes.
  std::vector<SpatialGaussian> components;
  for (const Vec3 to : {Vec3{0, 0, 3}, {2, 0, 2}, {-1, 1, 0.5f}, {0, -2, -1}}) {
    components.push_back({0.25f, kOrigin + to, {0.2f, 0, 0.2f, 0, 0, 0.2f}});
  }
  // The narrow lobe is a hundred times as high as the wide one, which still counts.
  const ScatteringLobe lobes[] = {{normalize(Vec3{0.2f, 0, 1}), 200, 100}, {{0, 0, 1}, 2, 1}};
  std::vector<double> shares;
  RandomStream random(5);
  for (const SpatialGaussian& g : components) {
    double sum = 0;
    constexpr int kDraws = 20'000;
    for (int i = 0; i < kDraws; ++i) {
      const Vec3 w = normalize(point_of(g, kOrigin, random));
      for (const ScatteringLobe& lobe : lobes) {
        sum += lobe.peak * std::exp(lobe.kappa * (dot(lobe.mean, w) - 1)) / kDraws;
      }
    }
    double even = 0;
    for (const ScatteringLobe& lobe : lobes) {
      even += lobe.peak / von_mises_fisher::mode_density(lobe.kappa) * double{warp::sphere_pdf()};
    }
    shares.push_back(std::max(sum / even, 0.01) * g.weight);
  }
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  Arena arena;
  const SeenMixture* seen =
      SeenMixture::make(components, kOrigin, {.lobes = lobes}, Technique::exact, arena);
  REQUIRE(seen != nullptr);
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Vec3 w = normalize(components[k].mean - kOrigin);
    double expected = 0;
    for (std::size_t j = 0; j < components.size(); ++j) {
      expected += shares[j] / total * exact_density(components[j], kOrigin, w);
    }
    CHECK(seen->density(w) == doctest::Approx(expected).epsilon(0.05));
  }
}

TEST_CASE("a mixture is the sum of its components, weighted by their cosines") {
  RandomStream random(10);
  Arena arena;
  for (const std::size_t count : {1u, 7u, 8u, 9u, 32u}) {
    const std::vector<SpatialGaussian> components = mixed_components(count, random);
    const Vec3 normal = any_direction(random);
    std::vector<double> shares;
    double total = 0;
    for (const SpatialGaussian& g : components) {
      const double cosine = dot(normal, normalize(g.mean - kOrigin));
      shares.push_back(g.weight * std::max(cosine, 0.01));
      total += shares.back();
    }
    arena.reset();
    const SeenMixture* seen =
        SeenMixture::make(components, kOrigin, {normal, false, 0.01f}, Technique::exact, arena);
    for (int i = 0; i < 20; ++i) {
      const Vec3 w = any_direction(random);
      double expected = 0;
      for (std::size_t k = 0; k < count; ++k) {
        expected += shares[k] / total * exact_density(components[k], kOrigin, w);
      }
      CHECK(seen->density(w) == doctest::Approx(expected).epsilon(1e-4).scale(1e-20));
    }
  }
}

}  // namespace
}  // namespace pharos::spatial_gaussians
