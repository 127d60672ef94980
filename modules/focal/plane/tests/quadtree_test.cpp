#include "../quadtree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>

#include "../guide.h"
#include "angle_fit.h"

namespace pharos::focal::plane {
namespace {

constexpr Cell kRegion{{-1.5, 0}, {3, 1}};

/// Returns a tree refined twice with noisy masses that concentrate around (0.3, 0.6).
Quadtree crowded_tree(const Quadtree::SplitRule& rule = {}) {
  Quadtree tree(kRegion, rule);
  RandomStream random(5);
  for (int i = 0; i < 2; ++i) {
    Quadtree::Sums sums = tree.empty_sums();
    tree.for_each_leaf([&](const Quadtree::Child&, const Cell& cell, std::size_t index) {
      const double dx = cell.low.x - 0.3, dy = cell.low.y - 0.6;
      sums[index] = cell.area() * uniform_number(random) / (1e-4 + dx * dx + dy * dy);
    });
    tree = tree.refined(sums, rule);
  }
  return tree;
}

double total_mass(const Quadtree& tree) {
  double sum = 0;
  tree.for_each_leaf(
      [&](const Quadtree::Child& leaf, const Cell&, std::size_t) { sum += leaf.mass; });
  return sum;
}

/// Integrates density(origin + t direction) t dt by small steps, leaf by leaf.
double stepped_density(const Quadtree& tree, const Ray& ray) {
  double sum = 0;
  tree.for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
    const Stretch stretch = ray.within(cell);
    if (!(stretch.begin < stretch.end)) return;
    sum += leaf.mass / cell.area() *
           testing::integrate([](double t) { return t; }, stretch.begin, stretch.end, 3);
  });
  return sum;
}

}  // namespace

TEST_CASE("quadtree: the uniform density is refined to cells below the threshold") {
  const Quadtree tree(kRegion, {});
  CHECK(tree.leaf_count() == 1024);  // 4^-5 < 1e-3 < 4^-4
  CHECK(total_mass(tree) == doctest::Approx(1));
  tree.for_each_leaf([](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
    CHECK(leaf.mass == doctest::Approx(1.0 / 1024));
    CHECK(cell.area() == doctest::Approx(3.0 / 1024));
  });
}

TEST_CASE("quadtree: one full leaf splits over as many levels as it may, empty nodes collapse") {
  const Quadtree::SplitRule rule{.threshold = 1e-3, .max_depth = 12};
  const Quadtree even(kRegion, rule);
  Quadtree::Sums sums = even.empty_sums();
  Cell full{};
  even.for_each_leaf([&](const Quadtree::Child&, const Cell& cell, std::size_t index) {
    if (index % 97 == 40 && full.area() == 0) full = cell, sums[index] = 7;
  });
  REQUIRE(full.area() > 0);
  const Quadtree tree = even.refined(sums, rule);
  CHECK(total_mass(tree) == doctest::Approx(1));
  // There are five levels below the full leaf, and each of the five nodes on the way has three
  // other leaves.
  CHECK(tree.leaf_count() == 1024 + 3 * 5);
  tree.for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
    const double x = cell.low.x - full.low.x, y = cell.low.y - full.low.y;
    const bool inside = x >= 0 && x < full.size.x && y >= 0 && y < full.size.y;
    CHECK(leaf.mass == (inside ? doctest::Approx(1.0 / 1024) : doctest::Approx(0)));
  });
}

TEST_CASE("quadtree: no leaf is deeper than the rule allows") {
  const Quadtree tree = crowded_tree({.threshold = 1e-5, .max_depth = 3});
  tree.for_each_leaf([](const Quadtree::Child&, const Cell& cell, std::size_t) {
    CHECK(cell.size.y >= 1.0 / 16);
  });
  CHECK(tree.leaf_count() == 256);
}

TEST_CASE("quadtree: without any sum everything stays as it is") {
  const Quadtree tree = crowded_tree(), same = tree.refined(tree.empty_sums(), {});
  CHECK(same.leaf_count() == tree.leaf_count());
}

TEST_CASE("quadtree: the traversal equals the sum over all leaves") {
  const Quadtree tree = crowded_tree();
  RandomStream random(3);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point2 from{4 * uniform_number(random) - 2, 2 * uniform_number(random) - 0.5};
    const Ray ray(from, 2 * std::numbers::pi * uniform_number(random));
    const double walked = tree.directional_density(ray), summed = stepped_density(tree, ray);
    worst = std::max(worst, std::abs(walked - summed) / std::max(summed, 1e-12));
  }
  CHECK(worst < 1e-9);
}

TEST_CASE("quadtree: an upright ray along cell edges meets one side only") {
  const Quadtree even(kRegion, {});
  CHECK(even.directional_density(Ray({0, 0}, 0)) == doctest::Approx(1.0 / 3 / 2));
}

TEST_CASE("quadtree: the directional density integrates to one, from inside and from outside") {
  const Quadtree tree = crowded_tree();
  for (const Point2 from : {Point2{0, 0}, Point2{0.3, 0.55}, Point2{-2, 3}}) {
    const auto density = [&](double angle) { return tree.directional_density(Ray(from, angle)); };
    CHECK(testing::integrate(density, -std::numbers::pi, std::numbers::pi, 200'000) ==
          doctest::Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("quadtree: points fall into leaves as often as their masses say") {
  const Quadtree tree = crowded_tree();
  constexpr int kDraws = 100'000;
  RandomStream random(11);
  std::vector<Point2> points;
  for (int i = 0; i < kDraws; ++i) points.push_back(tree.sample(random));
  std::vector<double> observed, expected;
  tree.for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
    observed.push_back(static_cast<double>(std::count_if(points.begin(), points.end(), [&](auto p) {
      const double x = p.x - cell.low.x, y = p.y - cell.low.y;
      return x >= 0 && x < cell.size.x && y >= 0 && y < cell.size.y;
    })));
    expected.push_back(kDraws * leaf.mass);
  });
  CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-3);
}

}  // namespace pharos::focal::plane
