#include "../lobe_changes.h"

#include <doctest/doctest.h>

#include <pharos/statistics/quadrature.h>

#include "test_lobes.h"

namespace pharos::parallax_aware_mixtures {
namespace {

using namespace testing;

TEST_CASE("the cost of a merger is its chi-square divergence times the weight") {
  RandomStream random(1);
  for (int i = 0; i < 30; ++i) {
    const Mixture two = any_mixture(2, 0.5, 60, random);
    const Lobe &a = two[0], &b = two[1];
    const Lobe whole = merged(a, b);
    const auto excess = [&](Vec3 w) {
      const double both = density_of(two, w), one = whole.weight * density_of(whole, w);
      return (both - one) * (both - one) / one;
    };
    const double expected = statistics::integrate_sphere(excess, {.tolerance = 1e-5}, 48, 96).value;
    if (expected > 1e3) continue;  // dominated by directions where the merged lobe is almost zero
    CHECK(merge_cost(a, b) == doctest::Approx(expected).epsilon(2e-3).scale(1e-3));
  }
  const Lobe same{0.5, Direction::UnitX(), 50};
  CHECK(merge_cost(same, same) == doctest::Approx(0).scale(1));
}

TEST_CASE("merging adds weights and resultants") {
  const Lobe a{0.3, Direction::UnitX(), 100}, b{0.1, Direction::UnitZ(), 5};
  const Lobe whole = merged(a, b);
  CHECK(whole.weight == doctest::Approx(0.4));
  const Direction expected = (0.3 * von_mises_fisher::mean_cosine(100) * Direction::UnitX() +
                              0.1 * von_mises_fisher::mean_cosine(5) * Direction::UnitZ()) /
                             0.4;
  CHECK((whole.mean * von_mises_fisher::mean_cosine(whole.kappa) - expected).norm() < 1e-9);
}

TEST_CASE("halves merge to the lobe that they come from") {
  RandomStream random(2);
  for (int i = 0; i < 100; ++i) {
    const Lobe lobe = any_mixture(1, 0.5, 5000, random)[0];
    const Direction any = to_direction(any_direction(random));
    // The axis is about half a standard deviation long.
    const Direction axis = 0.4 / std::sqrt(lobe.kappa + 1) * (any - any.dot(lobe.mean) * lobe.mean);
    const auto parts = halves(lobe, axis, 1e6);
    CHECK(parts[0].weight == lobe.weight / 2);
    const Lobe whole = merged(parts[0], parts[1]);
    CHECK(whole.mean.dot(lobe.mean) == doctest::Approx(1).epsilon(1e-9));
    CHECK(whole.kappa == doctest::Approx(lobe.kappa).epsilon(1e-4));
    CHECK(whole.weight == doctest::Approx(lobe.weight));
  }
}

TEST_CASE("lobes point at the same place from anywhere; infinitely far ones do not turn") {
  const PlacedLobe lobe{{1, Direction::UnitZ(), 10}, 0.5};  // at (0, 0, 2)
  const PlacedLobe aside = lobe.seen_from(Direction(1.5, 0, 0));
  CHECK((aside.lobe.mean - Direction(-0.6, 0, 0.8)).norm() < 1e-12);
  CHECK(aside.inverse_distance == doctest::Approx(1 / 2.5));
  CHECK((aside.seen_from(Direction(-1.5, 0, 0)).lobe.mean - lobe.lobe.mean).norm() < 1e-12);
  const PlacedLobe far{{1, Direction::UnitZ(), 10}, 0};
  CHECK(far.seen_from(Direction(5, 6, 7)).lobe.mean == far.lobe.mean);
  CHECK(lobe.seen_from(Direction(0, 0, 2)).lobe.mean == lobe.lobe.mean);
}

/// Returns samples of uniform directions. The incident light has the density of a mixture.
std::vector<AimedSample> samples_of(const Mixture& light, int count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<AimedSample> all;
  for (int i = 0; i < count; ++i) {
    const Vec3 w = any_direction(random);
    const float p = warp::sphere_pdf();
    all.push_back({w, 0.25f, static_cast<float>(7 * density_of(light, w)) / p, p});
  }
  return all;
}

TEST_CASE("a mixture that is right has no divergence, one that is wrong has where it is wrong") {
  RandomStream random(3);
  const Mixture light = any_mixture(3, 1, 8, random);
  const auto samples = samples_of(light, 50'000, 4);
  const std::vector<Assessment> right = assess(light, samples, 1e-6f);
  for (const Assessment& a : right) {
    CHECK(a.samples == 50'000);
    CHECK(a.divergence() < 2e-3);
    CHECK(a.inverse / a.certainty == doctest::Approx(0.25));
  }
  // The expected divergence is computed by quadrature.
  Mixture wrong = light;
  wrong[0].kappa = 40;
  const std::vector<Assessment> assessed = assess(wrong, samples, 1e-6f);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto integrand = [&](Vec3 w) {
      const double q = density_of(wrong, w) + 1e-6, f = density_of(light, w);
      return wrong[k].weight * density_of(wrong[k], w) * (f / q - 1) * (f / q - 1);
    };
    const double expected = statistics::integrate_sphere(integrand, {.tolerance = 1e-5}).value;
    CHECK(assessed[k].divergence() == doctest::Approx(expected).epsilon(0.1).scale(1e-3));
  }
}

TEST_CASE("a sample that counts for several steps is assessed as so many samples") {
  RandomStream random(5);
  const Mixture light = any_mixture(3, 1, 8, random);
  const std::vector<AimedSample> found = samples_of(light, 5'000, 6);
  std::vector<AimedSample> plain, mixed;
  for (std::size_t i = 0; i < found.size(); ++i) {
    AimedSample sample = found[i];
    if (i % 3 == 0) sample.weight = 0;
    // A path splits in four, or survives in place of two.
    const bool splits = i % 2 == 0;
    plain.insert(plain.end(), splits ? 1 : 2, sample);
    sample.steps = splits ? 0.25f : 2;
    sample.weight *= sample.steps;
    mixed.insert(mixed.end(), splits ? 4 : 1, sample);
  }
  const std::vector<Assessment> a = assess(light, plain, 1e-6f), b = assess(light, mixed, 1e-6f);
  for (std::size_t k = 0; k < a.size(); ++k) {
    CHECK(b[k].samples == doctest::Approx(a[k].samples));
    CHECK(b[k].divergence() == doctest::Approx(a[k].divergence()).epsilon(1e-3));
    CHECK(b[k].weight == doctest::Approx(a[k].weight).epsilon(1e-3));
  }
}

TEST_CASE("the axis to split along is that of largest spread, half a standard deviation long") {
  // Two spots side by side along x, seen by one lobe.
  std::vector<AimedSample> samples;
  for (const float x : {-0.1f, 0.1f}) {
    samples.push_back({normalize(Vec3{x, 0.02f, 1}), 0, 1, 1});
    samples.push_back({normalize(Vec3{x, -0.02f, 1}), 0, 1, 1});
  }
  const Mixture one{{1, Direction::UnitZ(), 50}};
  const auto axis = assess(one, samples, 1e-6f)[0].half_axis(one[0].mean);
  REQUIRE(axis);
  CHECK(std::abs((*axis)[0]) == doctest::Approx(0.05).epsilon(0.02));
  CHECK(std::abs((*axis)[1]) < 1e-6);
  CHECK(!Assessment{}.half_axis(one[0].mean));
}

}  // namespace
}  // namespace pharos::parallax_aware_mixtures
