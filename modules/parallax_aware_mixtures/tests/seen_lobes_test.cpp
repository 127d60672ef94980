#include "../seen_lobes.h"

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>
#include <pharos/tests/read_only.h>

#include "test_lobes.h"

namespace pharos::parallax_aware_mixtures {
namespace {

using namespace testing;

std::vector<LobeGroup> groups_of(const Mixture& mixture, double inverse_distance = 0) {
  std::vector<LobeGroup> groups;
  append_groups(mixture, std::vector<double>(mixture.size(), inverse_distance), groups);
  return groups;
}

/// Returns the factors that the tests multiply mixtures by: none, one lobe, two lobes.
std::vector<std::vector<ScatteringLobe>> factor_lists() {
  return {{}, {{{0, 0, 1}, 2.18853f, 1}}, {{{0.6f, 0, 0.8f}, 300, 0.7f}, {{0, 0, 1}, 1.5f, 0.3f}}};
}

double factor_at(const std::vector<ScatteringLobe>& factors, Vec3 w) {
  if (factors.empty()) return 1;
  double sum = 0;
  for (const ScatteringLobe& f : factors) {
    sum += f.peak * std::exp(f.kappa * (to_direction(f.mean).dot(to_direction(w)) - 1));
  }
  return sum;
}

TEST_CASE("densities are the mixture times the factors, normalized") {
  RandomStream random(1);
  Arena arena;
  for (const std::size_t count : {1u, 5u, 8u, 19u}) {
    const Mixture mixture = any_mixture(count, 0.01, 500, random);
    const std::vector<LobeGroup> groups = groups_of(mixture);
    for (const auto& factors : factor_lists()) {
      CAPTURE(count);
      CAPTURE(factors.size());
      const SeenLobes* seen = SeenLobes::make(groups, {1, 2, 3}, factors, arena);
      REQUIRE(seen != nullptr);
      const auto product = [&](Vec3 w) { return density_of(mixture, w) * factor_at(factors, w); };
      const double norm = statistics::integrate_sphere(product, {.tolerance = 1e-6}, 48, 96).value;
      for (int i = 0; i < 50; ++i) {
        const Vec3 w = i % 2 == 0 ? any_direction(random) : draw_from(mixture, random);
        CHECK(seen->density(w) == doctest::Approx(product(w) / norm).epsilon(1e-3).scale(1e-6));
      }
    }
  }
}

TEST_CASE("draws follow their density, and it integrates to one") {
  RandomStream random(2);
  Arena arena;
  std::uint64_t seed = 10;
  for (const std::size_t count : {1u, 7u, 20u}) {
    const std::vector<LobeGroup> groups = groups_of(any_mixture(count, 0.001, 32768, random), 0.3);
    for (const auto& factors : factor_lists()) {
      const SeenLobes* seen = SeenLobes::make(groups, {0.5f, -1, 2}, factors, arena);
      const auto draw = [&](RandomStream& stream) -> std::optional<Vec3> {
        const float choice = stream.next_1d();
        return seen->sample(choice, stream.next_2d());
      };
      const auto fit = statistics::fit_direction_density(
          draw, [&](Vec3 w) { return double{seen->density(w)}; },
          {.draws = 100'000, .seed = seed++, .cells = 100, .quadrature_tolerance = 1e-3});
      CHECK(fit.chi_square.p_value > 1e-4);
      CHECK(fit.is_density(2e-3));
      CHECK(fit.integral == doctest::Approx(1).epsilon(3e-3));
    }
  }
}

TEST_CASE("lobes point at their place from wherever they are seen") {
  Arena arena;
  // The pivot is (1, 1, 1), and the light is 4 units above it.
  const std::vector<LobeGroup> groups = groups_of({{1, Direction::UnitZ(), 2000}}, 0.25);
  for (const Point3 vertex : {Point3{1, 1, 1}, {4, 1, 1}, {1, -2, 1}, {2, 3, 9}}) {
    const SeenLobes* seen = SeenLobes::make(groups, Point3{1, 1, 1} - vertex, {}, arena);
    const Vec3 expected = normalize(Point3{1, 1, 5} - vertex);
    CHECK(seen->density(expected) ==
          doctest::Approx(von_mises_fisher::mode_density(2000)).epsilon(1e-4));
    CHECK(dot(seen->sample(0.5f, {0.5f, 0.5f}), expected) == doctest::Approx(1).epsilon(1e-5));
  }
  // At the position of the light any direction is correct.
  CHECK(SeenLobes::make(groups, {0, 0, -4}, {}, arena)->density({0, 0, 1}) > 0);
}

TEST_CASE("opposite lobes of the same concentration leave a flat one") {
  Arena arena;
  const std::vector<LobeGroup> groups = groups_of({{1, Direction::UnitZ(), 2}});
  const ScatteringLobe opposite{{0, 0, -1}, 2, 1};
  const SeenLobes* seen = SeenLobes::make(groups, {}, {&opposite, 1}, arena);
  CHECK(seen->density({0, 0, 1}) == doctest::Approx(warp::sphere_pdf()).epsilon(1.1e-3));
  CHECK(seen->density({1, 0, 0}) == doctest::Approx(warp::sphere_pdf()).epsilon(2e-3));
}

TEST_CASE("where almost nothing is left, densities are finite or there is no distribution") {
  Arena arena;
  for (const float peak : {1.0f, 1e-2f, 1e-4f}) {
    for (float kappa = 20; kappa < 80; kappa += 0.25f) {
      CAPTURE(peak);
      CAPTURE(kappa);
      const std::vector<LobeGroup> groups = groups_of({{1, Direction::UnitZ(), kappa}});
      const ScatteringLobe opposite{{0, 0, -1}, kappa, peak};
      const SeenLobes* seen = SeenLobes::make(groups, {}, {&opposite, 1}, arena);
      if (seen != nullptr) CHECK(seen->density({1, 0, 0}) == doctest::Approx(warp::sphere_pdf()));
    }
  }
}

TEST_CASE("where nothing is left there is no distribution") {
  Arena arena;
  const std::vector<LobeGroup> groups = groups_of({{1, Direction::UnitZ(), 30'000}});
  const ScatteringLobe opposite{{0, 0, -1}, 30'000, 1};
  CHECK(SeenLobes::make(groups, {}, {&opposite, 1}, arena) == nullptr);
  CHECK(SeenLobes::make({}, {}, {}, arena) == nullptr);
}

TEST_CASE("saving changes nothing in lobes that others sample") {
  const LobeGroup group = groups_of({{1, Direction::UnitZ(), 30}}, 0.5).front();
  CHECK(test::saved_read_only(group) == test::saved(group));
}

}  // namespace
}  // namespace pharos::parallax_aware_mixtures
