#include <cmath>

#include <doctest/doctest.h>

#include "../cell_fit.h"
#include "test_gaussians.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;

constexpr double kEven = 1.0 / 12;  // variance of an even distribution over an edge

TEST_CASE("regularization: a shift in common correlates the vertices of few points") {
  Regularization rule;
  rule.shift = rule.shift_of_last = std::sqrt(kEven);
  // A single point: the published variance 0.1^2, and the shift in all blocks.
  const Matrix<9> one = regularized<9>(Matrix<9>::Zero(), 1, rule);
  CHECK(one(0, 0) == doctest::Approx(0.01 + kEven));
  CHECK(one(0, 3) == doctest::Approx(kEven));
  CHECK(one(8, 2) == doctest::Approx(kEven));
  CHECK(one(0, 1) == 0);
  CHECK(one(0, 4) == 0);
  // Two points at +-d: 1/10 of the sample covariance d d^T, 9/10 * 1/3 of its blocks, 9/10 * 2/3 of
  // the rest.
  Vector<9> d;
  d << 0.1, 0, 0, 0.2, 0.1, 0, -0.1, 0, 0.3;
  const Matrix<9> two = regularized<9>(d * d.transpose(), 2, rule);
  const double x1x1 = 0.1 * 0.01 + 0.3 * (0.01 / 3) + 0.6 * (0.01 + kEven);
  const double x2x2 = 0.1 * 0.04 + 0.3 * (0.05 / 3) + 0.6 * (0.01 + kEven);
  const double x1x2 = 0.1 * 0.02 + 0.3 * (0.02 / 3) + 0.6 * kEven;
  CHECK(two(0, 0) == doctest::Approx(x1x1));
  CHECK(two(3, 3) == doctest::Approx(x2x2));
  CHECK(two(0, 3) == doctest::Approx(x1x2));
  CHECK(two(0, 3) / std::sqrt(two(0, 0) * two(3, 3)) > 0.8);
  const Matrix<9> published = regularized<9>(d * d.transpose(), 2, {});
  CHECK(published(0, 3) == doctest::Approx(0.1 * 0.02 + 0.3 * (0.02 / 3)));
  CHECK(published(0, 3) / std::sqrt(published(0, 0) * published(3, 3)) < 0.5);
  // Four points need no fallback.
  CHECK(regularized<9>(d * d.transpose(), 4, rule) == regularized<9>(d * d.transpose(), 4, {}));
}

/// Returns the covariance [scene units^2] of the only component that a cell with an edge of 2
/// learns from a single sample.
Matrix<9> covariance_of_one(VertexKind after, bool translation) {
  const Cube cell{{4, 4, 4}, 2};
  const Triplet triplet{{Point3{4, 4, 9}, Point3{4.5f, 4, 4}, Point3{5, 4, 9}},
                        {VertexKind::surface, Event::smooth_reflect, after}};
  Reservoir reservoir(8);
  RandomStream random(1);
  reservoir.insert(triplet, 3, random);
  FitRule rule{.kind = {.environment = {50}}};
  rule.translation = translation;
  const CellFit fit = fit_cell(reservoir, cell, rule);
  REQUIRE(fit.knowledge.triplets.size() == 1);
  REQUIRE(fit.knowledge.triplets[0].components.size() == 1);
  const Matrix<9> l = fit.knowledge.triplets[0].components[0].cholesky();
  return l * l.transpose();
}

/// Returns how far the expected next vertex moves if the first two vertices move by one unit.
Vector<3> shift_of_next(const Matrix<9>& covariance) {
  Vector<6> shift;
  shift << 1, 0, 0, 1, 0, 0;
  return covariance.block<3, 6>(6, 0) * covariance.topLeftCorner<6, 6>().llt().solve(shift);
}

TEST_CASE("cells: with translation, a single path is expected in parallel to itself") {
  const Vector<3> without = shift_of_next(covariance_of_one(VertexKind::surface, false));
  CHECK(without.norm() < 1e-6);
  // The first two vertices observe the shift with variance 0.01 each: the expected shift is
  // 2 s / (2 s + 0.01) for the variance s.
  const Vector<3> with = shift_of_next(covariance_of_one(VertexKind::surface, true));
  CHECK(with[0] == doctest::Approx(2 * kEven / (2 * kEven + 0.01)).epsilon(1e-4));
  CHECK(std::abs(with[1]) < 1e-6);
}

TEST_CASE("cells: the environment shifts by as much, in scene units, and keeps its angle") {
  const Matrix<9> covariance = covariance_of_one(VertexKind::environment, true);
  CHECK(covariance(3, 6) == doctest::Approx(4 * kEven).epsilon(1e-4));
  CHECK(covariance(0, 3) == doctest::Approx(4 * kEven).epsilon(1e-4));
  CHECK(covariance(6, 6) == doctest::Approx(4 * kEven + 25).epsilon(1e-4));  // (0.1 * 50)^2
}

}  // namespace
}  // namespace pharos::vertex_triplets
