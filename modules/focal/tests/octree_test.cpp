#include "../octree.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/warp.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/tests/read_only.h>

#include "test_trees.h"

namespace pharos::focal {
namespace {

using namespace testing;

/// Integrates density t^2 over the line, leaf by leaf and without the traversal.
double summed_over_leaves(const Octree& octree, std::uint32_t node, const Box& box, Point3 from,
                          Vec3 direction, double begin, double end) {
  double sum = 0;
  for (unsigned c = 0; c < 8; ++c) {
    const Box cell = box.child(c);
    if (!octree.nodes()[node].is_leaf(c)) {
      sum += summed_over_leaves(octree, octree.nodes()[node].index(c), cell, from, direction, begin,
                                end);
      continue;
    }
    double t0 = begin, t1 = end;
    for (int axis = 0; axis < 3; ++axis) {
      const double reciprocal = 1.0 / direction[axis];
      const double a = (cell.low[axis] - from[axis]) * reciprocal;
      const double b = (cell.low[axis] + cell.size[axis] - from[axis]) * reciprocal;
      t0 = std::max(t0, std::min(a, b));
      t1 = std::min(t1, std::max(a, b));
    }
    if (t0 < t1) sum += octree.nodes()[node].density(c) * (t1 * t1 * t1 - t0 * t0 * t0) / 3;
  }
  return sum;
}

template <Side side>
double density_along(const Octree& octree, const Line& line) {
  DirectionalDensity<side> density(octree, line);
  while (density.advance()) {
  }
  return density.value();
}

/// Returns the number of the eighth of a leaf that contains a point: 8 (8 node + child) + octant.
std::size_t eighth_at(const Octree& octree, const Double3& p) {
  const auto octant = [&p](const Box& cell) {
    unsigned c = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      c |= (p[axis] >= cell.low[axis] + 0.5 * cell.size[axis] ? 1u : 0u) << axis;
    }
    return c;
  };
  Box cell = octree.box();
  for (std::uint32_t i = 0;;) {
    const unsigned c = octant(cell);
    cell = cell.child(c);
    if (octree.nodes()[i].is_leaf(c)) return 8 * (8 * std::size_t{i} + c) + octant(cell);
    i = octree.nodes()[i].index(c);
  }
}

/// Sets the masses of the eighths of all leaves below a node, numbered as by eighth_at().
void set_masses(const Octree& octree, std::uint32_t node, const Box& box,
                std::vector<double>& masses) {
  for (unsigned c = 0; c < 8; ++c) {
    const Box cell = box.child(c);
    if (octree.nodes()[node].is_leaf(c)) {
      const double mass = octree.nodes()[node].density(c) * cell.volume();
      std::fill_n(masses.begin() + 8 * (8 * std::ptrdiff_t{node} + c), 8, mass / 8);
    } else {
      set_masses(octree, octree.nodes()[node].index(c), cell, masses);
    }
  }
}

}  // namespace

TEST_CASE("octree: the traversal equals the sum over all leaves") {
  struct NamedTree {
    const char* name;
    Octree octree;
  };
  const NamedTree trees[] = {{"even", even_tree()},
                             {"random", random_tree(1)},
                             {"random too", random_tree(2)},
                             {"pinhole", pinhole_tree()},
                             {"one hot", one_hot_tree()}};
  RandomStream random(7);
  for (const NamedTree& tree : trees) {
    CAPTURE(tree.name);
    const Octree& octree = tree.octree;
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
      const Point3 from = point_in_box(random, {{-3, -1, 0}, {6, 5, 8}});
      const Vec3 direction = i % 2 == 0
                                 ? warp::sphere_from_square(random.next_2d())
                                 : normalize(point_near(random, {0.1f, 1.3f, 3.7f}, 0.03f) - from);
      const Line line(octree.box(), from, direction);
      for (const Side side : {Side::ahead, Side::behind}) {
        const double begin = side == Side::ahead ? 0 : -1e30, end = side == Side::ahead ? 1e30 : 0;
        const double walked = side == Side::ahead ? density_along<Side::ahead>(octree, line)
                                                  : density_along<Side::behind>(octree, line);
        const double summed =
            summed_over_leaves(octree, 0, octree.box(), from, direction, begin, end);
        worst = std::max(worst, std::abs(walked - summed) / std::max(summed, 1e-20));
      }
    }
    CHECK(worst < 1e-5);
  }
}

TEST_CASE("octree: lines within planes between cells count once") {
  const Octree octree = even_tree();
  const Box& box = octree.box();
  const auto at = [&](float x, float y, float z) {
    return Point3{static_cast<float>(box.low[0] + x * box.size[0]),
                  static_cast<float>(box.low[1] + y * box.size[1]),
                  static_cast<float>(box.low[2] + z * box.size[2])};
  };
  const double density = 1 / box.volume();
  // Lines from the center of the box along an axis lie in planes between eight cells.
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction;
    direction[axis] = 1;
    const double reach = 0.5 * box.size[axis];
    const double expected = density * reach * reach * reach / 3;
    for (const float sign : {1.0f, -1.0f}) {
      const Line line(box, at(0.5f, 0.5f, 0.5f), sign * direction);
      CHECK(density_along<Side::ahead>(octree, line) == doctest::Approx(expected));
      CHECK(density_along<Side::behind>(octree, line) == doctest::Approx(expected));
    }
  }
  // Lines in other planes between cells.
  for (const float x : {0.375f, 0.625f, 0.75f}) {
    const Line line(box, at(x, 0.3f, 0.5f), {0, 0, 1});
    const double reach = 0.5 * box.size[2], expected = density * reach * reach * reach / 3;
    CHECK(density_along<Side::ahead>(octree, line) == doctest::Approx(expected));
    CHECK(density_along<Side::behind>(octree, line) == doctest::Approx(expected));
  }
  // Lines from a face straight inward and straight away.
  const Line inwards(box, at(0, 0.3f, 0.3f), {1, 0, 0});
  CHECK(density_along<Side::ahead>(octree, inwards) ==
        doctest::Approx(density * std::pow(box.size[0], 3) / 3));
  CHECK(density_along<Side::behind>(octree, inwards) == doctest::Approx(0));
  CHECK(density_along<Side::ahead>(octree, Line(box, at(-1, 0.3f, 0.3f), {-1, 0, 0})) == 0);
}

TEST_CASE("octree: points are drawn by density, evenly within leaves") {
  RandomStream random(5);
  for (const NamedDensity& named : test_densities()) {
    CAPTURE(named.name);
    const Octree& octree = named.density.converging;
    CHECK(named.density.converging.mass() + named.density.diverging.mass() ==
          doctest::Approx(1).epsilon(1e-5));
    constexpr int kDraws = 400'000;
    std::vector<double> expected(64 * octree.nodes().size()), observed(expected.size());
    set_masses(octree, 0, octree.box(), expected);
    for (double& e : expected) e *= kDraws / octree.mass();
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 u = random.next_2d();
      ++observed[eighth_at(octree, octree.sample({u.x, u.y, random.next_1d()}))];
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i] == 0) REQUIRE(observed[i] == 0);
    }
    // The test makes 6 fits. At this level, a correct sampler fails one run in 1,700.
    CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-4);
  }
}

TEST_CASE("octree: a node without mass is drawn from evenly, and numbers near one stay inside") {
  const Octree empty(test_box(), {Octree::Node{}});
  CHECK(empty.mass() == 0);
  const double most = 1 - 0x1p-24;
  for (const Octree& octree : {empty, pinhole_tree(), one_hot_tree()}) {
    for (const Double3& u : {Double3{0, 0, 0}, Double3{most, most, most}, Double3{0, most, 0}}) {
      const Double3 p = octree.sample(u);
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(p[axis] >= octree.box().low[axis]);
        CHECK(p[axis] <= octree.box().low[axis] + octree.box().size[axis]);
      }
    }
  }
}

TEST_CASE("octree: the number 0 is drawn from cells of almost no mass") {
  Octree::Node root;
  for (unsigned c = 0; c < 8; ++c) root.set_density(c, c % 2 == 0 ? 1e-36f : 1e36f);
  const Octree octree(test_box(), {root});
  CHECK(octree.sample({0, 0, 0}) == octree.box().low);
}

TEST_CASE("octree: saving changes nothing in nodes that others traverse") {
  const Octree::Node node = pinhole_tree().nodes().front();
  CHECK(test::saved_read_only(node) == test::saved(node));
}

}  // namespace pharos::focal
