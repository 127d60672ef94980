#include "../mixture_changes.h"

#include <cmath>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include <pharos/core/warp.h>
#include <pharos/guiding/toolkit/seen_gaussian.h>

#include "test_gaussians.h"

namespace pharos::spatial_gaussians {
namespace {

using namespace testing;
using statistics::Matrix;
using statistics::Vector;

double normal_density(const Gaussian3& g, const Vector<3>& x) {
  const Vector<3> y = x - g.mean;
  return std::exp(-0.5 * y.dot(g.covariance.inverse() * y)) /
         std::sqrt(std::pow(2 * EIGEN_PI, 3) * g.covariance.determinant());
}

/// Returns the divergence of two weighted Gaussians from the Gaussian of their joint moments, times
/// their weight, by a sum over a grid.
double cost_by_grid(double wi, const Gaussian3& i, double wj, const Gaussian3& j) {
  const Moments3 joint =
      Moments3::of(wi, i.mean, i.covariance) + Moments3::of(wj, j.mean, j.covariance);
  const Gaussian3 whole{joint.mean(), joint.covariance()};
  constexpr int kSteps = 90;
  constexpr double kHalfWidth = 6, kStep = 2 * kHalfWidth / kSteps;
  const Matrix<3> l = Eigen::LLT<Matrix<3>>(whole.covariance).matrixL();
  double sum = 0;
  for (int x = 0; x < kSteps; ++x) {
    for (int y = 0; y < kSteps; ++y) {
      for (int z = 0; z < kSteps; ++z) {
        const Vector<3> u(-kHalfWidth + (x + 0.5) * kStep, -kHalfWidth + (y + 0.5) * kStep,
                          -kHalfWidth + (z + 0.5) * kStep);
        const Vector<3> p = whole.mean + l * u;
        const double two = wi * normal_density(i, p) + wj * normal_density(j, p);
        const double one = (wi + wj) * normal_density(whole, p);
        sum += (two - one) * (two - one) / one;
      }
    }
  }
  return sum * kStep * kStep * kStep * l.determinant();
}

Gaussian3 gaussian(Vector<3> mean, Vector<3> deviations) {
  return {mean, deviations.cwiseAbs2().asDiagonal()};
}

TEST_CASE("the cost of a merge is the divergence over space") {
  const Gaussian3 a = gaussian({0, 0, 0}, {1, 0.8, 0.9});
  for (const double apart : {0.0, 0.5, 1.0, 1.5}) {
    const Gaussian3 b = gaussian({apart, 0.2, 0}, {0.9, 0.9, 1.1});
    CAPTURE(apart);
    CHECK(merge_cost(0.2, a, 0.3, b) ==
          doctest::Approx(cost_by_grid(0.2, a, 0.3, b)).epsilon(1e-3));
  }
}

TEST_CASE("merging costs nothing for equal components and all for needles that cross") {
  const Gaussian3 a = gaussian({1, 2, 3}, {1, 2, 0.5});
  CHECK(std::abs(merge_cost(0.4, a, 0.1, a)) < 1e-12);
  const Gaussian3 along_x = gaussian({0, 0, 0}, {1, 0.01, 0.01});
  const Gaussian3 along_y = gaussian({0, 0, 0}, {0.01, 1, 0.01});
  CHECK(merge_cost(0.5, along_x, 0.5, along_y) > 1);
}

/// Returns samples of uniform directions from origins around the pivot. The incident light is
/// distributed like the directions to the points of the Gaussians `light`.
std::vector<Sample> uniform_samples(const std::vector<SpatialGaussian>& light, std::size_t count,
                                    std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const Point3 origin = 0.1f * any_direction(random);
    const Vec3 w = any_direction(random);
    double radiance = 0;
    for (const SpatialGaussian& g : light) radiance += g.weight * exact_density(g, origin, w);
    samples.push_back({.origin = origin,
                       .target = origin + 5.0f * w,
                       .weight = static_cast<float>(radiance) / warp::sphere_pdf(),
                       .pdf = warp::sphere_pdf()});
  }
  return samples;
}

constexpr float kLeast = 1e-4f;

Gaussian3 to_gaussian(const SpatialGaussian& g) {
  Matrix<3> l = Matrix<3>::Zero();
  l << g.cholesky[0], 0, 0, g.cholesky[1], g.cholesky[2], 0, g.cholesky[3], g.cholesky[4],
      g.cholesky[5];
  return {{g.mean.x, g.mean.y, g.mean.z}, l * l.transpose()};
}

TEST_CASE("the test of directions finds the component that has to stand for two") {
  RandomStream random(1);
  SpatialGaussian left = oriented_gaussian({-2, 0, 4}, {0.4f, 0.3f, 0.2f}, random);
  SpatialGaussian right = oriented_gaussian({2, 0, 4}, {0.3f, 0.2f, 0.4f}, random);
  SpatialGaussian back = oriented_gaussian({0, 0, -4}, {0.5f, 0.5f, 0.5f}, random);
  left.weight = right.weight = 0.3f;
  back.weight = 0.4f;
  const std::vector<Sample> samples = uniform_samples({left, right, back}, 40'000, 2);
  const Gaussian3 l = to_gaussian(left), r = to_gaussian(right), b = to_gaussian(back);
  const Moments3 both =
      Moments3::of(0.3, l.mean, l.covariance) + Moments3::of(0.3, r.mean, r.covariance);
  const Vector<3> pivot = Vector<3>::Zero();

  const auto fits = test_directions({{0.3, 0.3, 0.4}, {l, r, b}}, pivot, samples, kLeast);
  for (const DirectionTest& t : fits) {
    CHECK(t.samples == 40'000);
    CHECK(t.divergence() < 0.02);
  }
  const auto misfits =
      test_directions({{0.6, 0.4}, {{both.mean(), both.covariance()}, b}}, pivot, samples, kLeast);
  CHECK(misfits[0].divergence() > 0.5);
  CHECK(misfits[1].divergence() < 0.02);
}

TEST_CASE("samples that find nothing count") {
  RandomStream random(3);
  const SpatialGaussian g = oriented_gaussian({0, 0, 2}, {1, 1, 1}, random);
  std::vector<Sample> samples = uniform_samples({g}, 20'001, 4);
  const Mixture mixture{{1}, {to_gaussian(g)}};
  const double all = test_directions(mixture, Vector<3>::Zero(), samples, kLeast)[0].divergence();
  // Half of the samples lose their light. The estimated density f is then either twice the
  // mixture's density or zero.
  for (std::size_t i = 0; i < samples.size(); i += 2) samples[i].weight = 0;
  const auto half = test_directions(mixture, Vector<3>::Zero(), samples, kLeast)[0];
  CHECK(half.samples == 20'001);
  CHECK(half.divergence() == doctest::Approx(1).epsilon(0.1));
  CHECK(all < 0.02);
}

TEST_CASE("a sample that counts for several steps is tested as so many samples") {
  RandomStream random(7);
  const SpatialGaussian g = oriented_gaussian({0, 0, 2}, {1, 0.7f, 0.9f}, random);
  const Mixture mixture{{1}, {to_gaussian(g)}};
  const std::vector<Sample> found = uniform_samples({g}, 6'000, 8);
  std::vector<Sample> plain, mixed;
  for (std::size_t i = 0; i < found.size(); ++i) {
    Sample sample = found[i];
    if (i % 3 == 0) sample.weight = 0;
    // A path splits in four, or survives in place of two.
    const bool splits = i % 2 == 0;
    plain.insert(plain.end(), splits ? 1 : 2, sample);
    sample.steps = splits ? 0.25f : 2;
    sample.weight *= sample.steps;
    mixed.insert(mixed.end(), splits ? 4 : 1, sample);
  }
  const auto a = test_directions(mixture, Vector<3>::Zero(), plain, kLeast)[0];
  const auto b = test_directions(mixture, Vector<3>::Zero(), mixed, kLeast)[0];
  CHECK(b.samples == doctest::Approx(a.samples));
  CHECK(b.divergence() == doctest::Approx(a.divergence()).epsilon(1e-3));
}

TEST_CASE("mixtures are tested where they are: from any pivot, in any part, however compact") {
  RandomStream random(5);
  const SpatialGaussian g = oriented_gaussian({0, 0, 2}, {1, 0.6f, 0.8f}, random);
  const std::vector<Sample> samples = uniform_samples({g}, 9'001, 6);
  const Gaussian3 here = to_gaussian(g);
  const Vector<3> pivot(1, -2, 3);
  const Gaussian3 moved{here.mean - pivot, here.covariance};
  const double a = test_directions({{1}, {here}}, Vector<3>::Zero(), samples, kLeast)[0].sum;
  const double b = test_directions({{1}, {moved}}, pivot, samples, kLeast)[0].sum;
  CHECK(b == doctest::Approx(a).epsilon(1e-3));
  // The density of so small a component is zero in almost all directions.
  const Gaussian3 dot{here.mean, 1e-8 * Matrix<3>::Identity()};
  const auto compact = test_directions({{1}, {dot}}, Vector<3>::Zero(), samples, kLeast)[0];
  CHECK(std::isfinite(compact.sum));
  CHECK(compact.samples == 9'001);
}

}  // namespace
}  // namespace pharos::spatial_gaussians
