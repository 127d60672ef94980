#include <cmath>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "../conditional_mixtures.h"
#include "test_gaussians.h"
#include "test_next_vertices.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;
using Mixtures = ConditionalMixtures<6>;

const Point3 kCenter{3, -1, 2};
const Mode kMode{VertexKind::surface, Event::smooth_reflect, VertexKind::surface};

/// Returns random Gaussians over (x_1, x_2, x_3), relative to kCenter.
std::vector<Gaussian<9>> any_gaussians(int count, std::uint64_t seed) {
  std::vector<Gaussian<9>> gaussians;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) gaussians.push_back(any_gaussian<9>(random, 1, 0.2));
  return gaussians;
}

Mixtures::Run run_of(const std::vector<Gaussian<9>>& gaussians, const Mode& mode = kMode) {
  Mixtures::Run run{mode, {}};
  for (const auto& g : gaussians) {
    run.components.push_back(make_component<6>(1.0 / static_cast<double>(gaussians.size()), g));
  }
  return run;
}

Point3 vertex(const Vector<9>& triplet, int i) {
  Point3 p = kCenter;
  for (int axis = 0; axis < 3; ++axis) p[axis] += static_cast<float>(triplet[3 * i + axis]);
  return p;
}
Vector<9> triplet_of(Point3 a, Point3 b, Point3 c) {
  Vector<9> x;
  for (int axis = 0; axis < 3; ++axis) {
    x[axis] = double{a[axis]} - kCenter[axis];
    x[3 + axis] = double{b[axis]} - kCenter[axis];
    x[6 + axis] = double{c[axis]} - kCenter[axis];
  }
  return x;
}

double density_of(const SpatialGaussian& g, Point3 p) {
  const std::array<double, 3> z =
      whitened(g, {double{p.x} - g.mean.x, double{p.y} - g.mean.y, double{p.z} - g.mean.z});
  return std::exp(-0.5 * (z[0] * z[0] + z[1] * z[1] + z[2] * z[2])) /
         (std::pow(2 * EIGEN_PI, 1.5) * root_determinant(g));
}
double density_of(std::span<const NextVertex> next, Point3 p) {
  double sum = 0;
  for (const NextVertex& v : next) sum += v.gaussian.weight * density_of(v.gaussian, p);
  return sum;
}
double joint(const std::vector<Gaussian<9>>& gaussians, const Vector<9>& x) {
  double sum = 0;
  for (const auto& g : gaussians) sum += density(g, x) / static_cast<double>(gaussians.size());
  return sum;
}

TEST_CASE("conditional: the joint density over its integral, found by summing it up") {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto gaussians = any_gaussians(3, seed);
    Mixtures mixtures(Mixtures::Direction::from_sensor);
    mixtures.add_cell(kCenter, std::vector{run_of(gaussians)});
    RandomStream random(seed, 1);
    // The prefix is within the support of all components, so that truncation leaves none out.
    Vector<9> x = (gaussians[0].mean + gaussians[1].mean + gaussians[2].mean) / 3;
    x.head<6>() += 0.05 * normal_vector<6>(random);
    Arena arena;
    const auto next = vertices_of(mixtures.given(0, {vertex(x, 0), vertex(x, 1)}, arena));
    double shares = 0;
    for (const NextVertex& v : next) shares += v.gaussian.weight;
    if (next.size() < 3) continue;
    ++compared;
    CHECK(shares == doctest::Approx(1));
    constexpr int kSteps = 40;
    constexpr double kReach = 7, kStep = 2 * kReach / kSteps;
    double integral = 0;
    for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
      Vector<9> at = triplet_of(vertex(x, 0), vertex(x, 1), kCenter);
      for (int axis = 0, rest = i; axis < 3; ++axis, rest /= kSteps) {
        at[6 + axis] = (rest % kSteps + 0.5) * kStep - kReach;
      }
      integral += joint(gaussians, at) * kStep * kStep * kStep;
    }
    for (int i = 0; i < 20; ++i) {
      const NextVertex& v = next[static_cast<std::size_t>(i) % next.size()];
      const Vector<3> z = normal_vector<3>(random);
      const Point3 p =
          v.gaussian.mean + spread(v.gaussian, {static_cast<float>(z[0]), static_cast<float>(z[1]),
                                                static_cast<float>(z[2])});
      const double expected =
          joint(gaussians, triplet_of(vertex(x, 0), vertex(x, 1), p)) / integral;
      CHECK(density_of(next, p) == doctest::Approx(expected).epsilon(2e-3).scale(1e-3));
    }
  }
  CHECK(compared >= 3);
}

TEST_CASE("conditional: mean and covariance of appendix A") {
  const auto g = any_gaussians(1, 5)[0];
  Mixtures mixtures(Mixtures::Direction::from_sensor);
  mixtures.add_cell(kCenter, std::vector{run_of({g})});
  RandomStream random(3);
  for (int i = 0; i < 20; ++i) {
    const Vector<9> x = g.mean + 0.3 * (point_of(g, random) - g.mean);
    Arena arena;
    const auto next = vertices_of(mixtures.given(0, {vertex(x, 0), vertex(x, 1)}, arena));
    REQUIRE(next.size() == 1);
    const Eigen::Matrix<double, 3, 6> gain =
        g.covariance.bottomLeftCorner<3, 6>() * g.covariance.topLeftCorner<6, 6>().inverse();
    const Vector<3> mean = g.mean.tail<3>() + gain * (x - g.mean).head<6>();
    const Matrix<3> covariance =
        g.covariance.bottomRightCorner<3, 3>() - gain * g.covariance.topRightCorner<6, 3>();
    const SpatialGaussian expected = spatial({mean, covariance});
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(next[0].gaussian.mean[axis] ==
            doctest::Approx(kCenter[axis] + expected.mean[axis]).epsilon(1e-4));
    }
    for (int j = 0; j < 6; ++j) {
      CHECK(next[0].gaussian.cholesky[j] == doctest::Approx(expected.cholesky[j]).epsilon(1e-3));
    }
  }
}

TEST_CASE("conditional: backwards it is that of the triplets turned around") {
  const auto gaussians = any_gaussians(4, 9);
  Mixtures backwards(Mixtures::Direction::from_lights), turned(Mixtures::Direction::from_lights);
  Mixtures::Run reversed_run = run_of(gaussians);
  for (auto& c : reversed_run.components) c = reversed(c);
  backwards.add_cell(kCenter, std::vector{reversed_run});
  std::vector<Gaussian<9>> permuted;
  Matrix<9> p = Matrix<9>::Zero();
  for (int i = 0; i < 9; ++i) p(i, 6 - i / 3 * 3 + i % 3) = 1;
  for (const auto& g : gaussians)
    permuted.push_back({p * g.mean, p * g.covariance * p.transpose()});
  turned.add_cell(kCenter, std::vector{run_of(permuted)});
  RandomStream random(4);
  int answers = 0;
  for (int i = 0; i < 50; ++i) {
    const Vector<9> x = point_of(gaussians[i % 4], random);
    Arena a, b;
    const auto from = vertices_of(backwards.given(0, {vertex(x, 2), vertex(x, 1)}, a));
    const auto expected = vertices_of(turned.given(0, {vertex(x, 2), vertex(x, 1)}, b));
    if (from.size() != expected.size()) continue;  // the prefix is at the edge of a support
    ++answers;
    CHECK(density_of(from, vertex(x, 0)) ==
          doctest::Approx(density_of(expected, vertex(x, 0))).epsilon(1e-3));
  }
  CHECK(answers > 40);
}

TEST_CASE("conditional: beyond four standard deviations nothing is known") {
  Gaussian<9> g;  // a unit one
  Mixtures mixtures(Mixtures::Direction::from_sensor);
  mixtures.add_cell(kCenter, std::vector{run_of({g})});
  Arena arena;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      Point3 within = kCenter, beyond = kCenter;
      within[axis] += sign * 3.999f;
      beyond[axis] += sign * 4.001f;
      CHECK(vertices_of(mixtures.given(0, {within, within}, arena)).size() == 1);
      CHECK(mixtures.given(0, {kCenter, beyond}, arena).empty());
      CHECK(mixtures.given(0, {beyond, kCenter}, arena).empty());
    }
  }
}

TEST_CASE("conditional: prefixes can be unknown nearer than the truncation") {
  Gaussian<9> g;  // a unit one
  Mixtures mixtures(Mixtures::Direction::from_sensor);
  mixtures.add_cell(kCenter, std::vector{run_of({g})});
  Arena arena;
  const auto is_known = [&](Vec3 previous, Vec3 current) {
    PathPrefix prefix{.previous = kCenter + previous, .current = kCenter + current};
    prefix.most_deviations = 1.5f;
    return !mixtures.given(0, prefix, arena).empty();
  };
  const auto all = [](float x) { return Vec3{x, x, x}; };
  CHECK(is_known(all(1.499f), all(-1.499f)));
  CHECK(!is_known(all(1.501f), all(-1.501f)));
  // The root of the mean of the squares decides, not the largest coordinate.
  CHECK(is_known({3.67f, 0, 0}, {}));  // 3.67^2 / 6 = 1.498^2
  CHECK(!is_known({0, 0, 0}, {0, 3.68f, 0}));
  // One component that is near enough suffices.
  Gaussian<9> other = g;
  other.mean[0] = 3;
  mixtures.add_cell(kCenter, std::vector{run_of({g, other})});
  const PathPrefix between{
      .previous = kCenter + Vec3{3.7f, 0, 0}, .current = kCenter, .most_deviations = 1.5f};
  CHECK(mixtures.given(0, between, arena).empty());
  CHECK(vertices_of(mixtures.given(1, between, arena)).size() == 2);
}

TEST_CASE("conditional: components that contradict the path are left out") {
  using enum VertexKind;
  const auto g = any_gaussians(1, 5);
  const std::vector<Mixtures::Run> runs{run_of(g, {surface, Event::smooth_reflect, surface}),
                                        run_of(g, {surface, Event::smooth_transmit, volume}),
                                        run_of(g, {sensor, Event::smooth_reflect, environment}),
                                        run_of(g, {surface, Event::smooth_reflect, light}),
                                        run_of(g, {sensor, Event::scatter, surface}),
                                        run_of(g, {volume, Event::discrete_reflect, surface})};
  Mixtures forward(Mixtures::Direction::from_sensor), backward(Mixtures::Direction::from_lights);
  forward.add_cell(kCenter, runs);
  backward.add_cell(kCenter, runs);
  const Point3 a = vertex(g[0].mean, 0), b = vertex(g[0].mean, 1);
  Arena arena;
  const auto count = [&](const Mixtures& m, VertexKind previous, EventMask events) {
    return m.given(0, {a, b, previous, events}, arena).size();
  };
  CHECK(count(forward, surface, EventMask::all) == 2);  // the one to a `light` is left out
  CHECK(count(forward, surface, mask_of(Event::smooth_reflect)) == 1);
  CHECK(count(forward, surface, EventMask::transmit) == 1);
  CHECK(count(forward, sensor, EventMask::all) == 2);
  CHECK(count(forward, sensor, mask_of(Event::scatter)) == 1);
  CHECK(count(forward, volume, EventMask::all) == 1);
  CHECK(count(forward, volume, EventMask::smooth) == 0);
  CHECK(count(forward, environment, EventMask::all) == 0);
  CHECK(count(backward, light, EventMask::all) == 1);
  CHECK(count(backward, environment, EventMask::all) == 0);  // no step can hit the sensor
  CHECK(count(backward, volume, EventMask::all) == 1);
  const auto next = vertices_of(forward.given(0, {a, b, surface, EventMask::transmit}, arena));
  CHECK(next[0].kind == volume);
  CHECK(next[0].event == Event::smooth_transmit);
  CHECK(next[0].gaussian.weight == doctest::Approx(1));
}

TEST_CASE("conditional: mixtures of any number of components, as they were added") {
  for (const int count : {1, 7, 8, 9, 16, 33}) {
    Mixtures mixtures(Mixtures::Direction::from_sensor);
    mixtures.add_cell({}, {});
    const std::vector runs{run_of(any_gaussians(count, 1)),
                           run_of(any_gaussians(3, 2), {VertexKind::sensor})};
    mixtures.add_cell(kCenter, runs);
    CHECK(mixtures.cell_count() == 2);
    CHECK(static_cast<int>(mixtures.component_count()) == count + 3);
    CHECK(mixtures.runs(0).empty());
    const auto copies = mixtures.runs(1);
    REQUIRE(copies.size() == 2);
    for (std::size_t r = 0; r < 2; ++r) {
      CHECK(copies[r].mode == runs[r].mode);
      REQUIRE(copies[r].components.size() == runs[r].components.size());
      for (std::size_t i = 0; i < copies[r].components.size(); ++i) {
        CHECK(copies[r].components[i].weight == runs[r].components[i].weight);
        CHECK(copies[r].components[i].mean == runs[r].components[i].mean);
        CHECK(copies[r].components[i].factor == runs[r].components[i].factor);
      }
    }
  }
}

TEST_CASE("conditional: pairs do not ask where the path comes from") {
  RandomStream random(6);
  const Gaussian<6> g = any_gaussian<6>(random);
  ConditionalMixtures<3> mixtures(ConditionalMixtures<3>::Direction::from_sensor);
  mixtures.add_cell(kCenter,
                    std::vector<ConditionalMixtures<3>::Run>{{kMode, {make_component<3>(1, g)}}});
  const Point3 here = kCenter + Vec3{static_cast<float>(g.mean[0]), static_cast<float>(g.mean[1]),
                                     static_cast<float>(g.mean[2])};
  Arena arena;
  const auto near = vertices_of(mixtures.given(0, {here, here, VertexKind::sensor}, arena));
  const auto far = vertices_of(mixtures.given(0, {{100, 0, 0}, here, VertexKind::volume}, arena));
  REQUIRE(near.size() == 1);
  REQUIRE(far.size() == 1);
  CHECK(near[0].gaussian.mean == far[0].gaussian.mean);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(near[0].gaussian.mean[axis] ==
          doctest::Approx(kCenter[axis] + g.mean[3 + axis]).epsilon(1e-5));
  }
}

}  // namespace
}  // namespace pharos::vertex_triplets
