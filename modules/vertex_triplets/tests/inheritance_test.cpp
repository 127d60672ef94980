#include "../inheritance.h"

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "../cell_fit.h"
#include "test_gaussians.h"
#include "test_mirror.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;
using test::saved;

template <int D>
std::array<float, D> filled(float value) {
  std::array<float, D> x;
  x.fill(value);
  return x;
}

// --- the most probable mixture -------------------------------------------------------------------

TEST_CASE(
    "beliefs: components have the moments and the weights of real and believed points together") {
  const Belief<3> belief{30, {Vector<3>(1, 0, 0), 0.5 * Matrix<3>::Identity()}};
  Sums<3> sums;
  sums.weight = 10;
  sums.squared_weight = 10;  // ten points of weight 1
  sums.first = 10 * Vector<3>(2, 0, 0);
  sums.second = 10 * (Matrix<3>::Identity() + Vector<3>(2, 0, 0) * Vector<3>(2, 0, 0).transpose());
  // The points have the mean 3 and the covariance 1.
  const Gaussian<3> g = most_probable<3>(sums, Vector<3>(1, 0, 0), belief, {});
  CHECK(g.mean.isApprox(Vector<3>(0.25 * 3 + 0.75 * 1, 0, 0)));
  const double of_sample = 9.0 / 12;
  const double across = 0.25 * 1 + 0.75 * 0.5, along = across + 0.25 * 0.75 * 4;
  CHECK(g.covariance(0, 0) == doctest::Approx(of_sample * along + (1 - of_sample) * 0.5));
  CHECK(g.covariance(1, 1) == doctest::Approx(of_sample * across + (1 - of_sample) * 0.5));
  CHECK(g.covariance(0, 1) == 0);
  // Without points the belief remains; without belief the points alone count.
  CHECK(most_probable<3>({}, Vector<3>::Zero(), belief, {}).mean == belief.gaussian.mean);
  CHECK(most_probable<3>(sums, Vector<3>(1, 0, 0), {}, {})
            .covariance.isApprox(regularized<3>(Matrix<3>::Identity(), 10, {})));
}

TEST_CASE("beliefs: one point moves its component and leaves the other one") {
  RandomStream random(4);
  Gaussian<9> near = any_gaussian<9>(random, 0.1), far = any_gaussian<9>(random, 0.1);
  near.mean.setZero();
  far.mean.setConstant(50);
  const Beliefs<9> beliefs{{1, near}, {2, far}};
  Points<9> point;
  point.add(filled<9>(0.001f), 1);
  const Mixture<9> mixture = fit_clusters(point, {}, beliefs);
  REQUIRE(mixture.size() == 2);
  CHECK(mixture.weights[0] == doctest::Approx(0.5));  // (1 + 1) / 4
  CHECK(mixture.components[0].mean.isApprox(Vector<9>::Constant(0.0005), 1e-3));
  CHECK(mixture.components[0].covariance.isApprox(near.covariance, 1e-6));
  CHECK(mixture.components[1].mean.isApprox(far.mean));
  CHECK(mixture.components[1].covariance.isApprox(far.covariance));
}

TEST_CASE("beliefs: a point that no belief explains gets a component of its own") {
  const Beliefs<9> beliefs{{5, {Vector<9>::Zero(), 0.01 * Matrix<9>::Identity()}}};
  Points<9> points;
  points.add(filled<9>(0.05f), 1);
  points.add(filled<9>(3), 1);
  const Mixture<9> mixture = fit_clusters(points, {}, beliefs);
  REQUIRE(mixture.size() == 2);
  CHECK(mixture.weights[0] == doctest::Approx(6.0 / 7));
  CHECK(mixture.components[0].mean.isApprox(Vector<9>::Constant(0.05 / 6), 1e-3));
  CHECK(mixture.components[1].mean.isApprox(Vector<9>::Constant(3), 1e-5));
  // If there is no room, the belief must explain it after all.
  CHECK(fit_clusters(points, {.most_components = 1}, beliefs).size() == 1);
}

TEST_CASE("beliefs: many points are split into as many components as without belief") {
  RandomStream random(6);
  Points<9> points;
  for (int i = 0; i < 3000; ++i) {
    Vector<9> x = 0.1 * normal_vector<9>(random);
    x[0] += i % 3;
    std::array<float, 9> f;
    for (int axis = 0; axis < 9; ++axis) f[axis] = static_cast<float>(x[axis]);
    points.add(f, 1);
  }
  // The belief is wrong: one component for all of them, of another shape.
  const Beliefs<9> beliefs{{10, {Vector<9>::Constant(0.5), Matrix<9>::Identity()}}};
  const Mixture<9> with = fit_clusters(points, {}, beliefs), without = fit_clusters(points, {});
  CHECK(without.size() >= 3);
  CHECK(with.size() == without.size());
  const double loss =
      expectation(without, points).log_likelihood - expectation(with, points).log_likelihood;
  CHECK(std::abs(loss) < 0.03);
}

TEST_CASE("beliefs: points refute a belief of another shape, if they are enough") {
  RandomStream random(8);
  // Believes in a deviation of 1; the points have 0.1.
  const Beliefs<9> beliefs{{10, {Vector<9>::Zero(), Matrix<9>::Identity()}}};
  const auto variance = [&](int count) {
    Points<9> points;
    for (int i = 0; i < count; ++i) {
      const Vector<9> x = 0.1 * normal_vector<9>(random);
      std::array<float, 9> f;
      for (int axis = 0; axis < 9; ++axis) f[axis] = static_cast<float>(x[axis]);
      points.add(f, 1);
    }
    const Mixture<9> mixture = fit_clusters(points, {.most_components = 1}, beliefs);
    return mixture.components[0].covariance.trace() / 9;
  };
  CHECK(variance(2) > 0.8);
  CHECK(variance(400) == doctest::Approx(0.01).epsilon(0.1));
}

// --- what a part of a cell inherits --------------------------------------------------------------

const Mode kMode{VertexKind::surface, Event::smooth_reflect, VertexKind::surface};
const Mode kOtherMode{VertexKind::surface, Event::smooth_transmit, VertexKind::surface};

/// Returns a component whose current vertex is near `current`, relative to the center of its cell.
Component<6> component_at(Point3 current, double weight, double deviation = 0.1) {
  Gaussian<9> gaussian{Vector<9>::Constant(3), deviation * deviation * Matrix<9>::Identity()};
  for (int axis = 0; axis < 3; ++axis) gaussian.mean[3 + axis] = current[axis];
  return make_component<6>(weight, gaussian);
}

TEST_CASE("inheritance: the components in the part, relative to its center") {
  const Cube divided{{10, 20, 30}, 4};
  CellKnowledge knowledge;
  knowledge.triplets = {{kMode, {component_at({-1, -1, -1}, 0.3), component_at({1, 1, 1}, 0.1)}},
                        {kOtherMode, {component_at({-1, -1, -1}, 0.1)}}};
  const Inheritance low = inheritance(knowledge, divided, divided.part(0));
  CHECK(low.pairs.empty());
  REQUIRE(low.triplets.size() == 2);
  REQUIRE(low.triplets[0].components.size() == 1);
  CHECK(low.triplets[0].components[0].weight == doctest::Approx(0.75));
  CHECK(low.triplets[1].components[0].weight == doctest::Approx(0.25));
  const auto& mean = low.triplets[0].components[0].mean;
  CHECK(mean[0] == doctest::Approx(4));  // 3 from 10 is 4 from 9
  CHECK(mean[3] == doctest::Approx(0));
  CHECK(mean[8] == doctest::Approx(4));
  const Inheritance high = inheritance(knowledge, divided, divided.part(7));
  REQUIRE(high.triplets.size() == 1);
  CHECK(high.triplets[0].components[0].weight == doctest::Approx(1));
  CHECK(inheritance(knowledge, divided, divided.part(1)).empty());
}

TEST_CASE("inheritance: a component at the border belongs to both sides, by its probabilities") {
  const Cube divided{{0, 0, 0}, 4};
  CellKnowledge knowledge;
  // One deviation into the upper half along x.
  knowledge.triplets = {{kMode, {component_at({0.1f, 1, 1}, 0.5), component_at({-1, 1, 1}, 0.5)}}};
  const Inheritance low = inheritance(knowledge, divided, divided.part(6));
  REQUIRE(low.triplets[0].components.size() == 2);
  CHECK(low.triplets[0].components[0].weight == doctest::Approx(0.158655 / 1.158655).epsilon(1e-4));
  const Inheritance high = inheritance(knowledge, divided, divided.part(7));
  REQUIRE(high.triplets[0].components.size() == 1);
}

// --- cells ---------------------------------------------------------------------------------------

const Cube kCell{{1, 2, 3}, 2};

Triplet triplet_of(const Mode& mode, float offset = 0) {
  return {{Point3{4 + offset, 5, 6}, Point3{1 + offset, 2, 3}, Point3{4 + offset, 5, 6}}, mode};
}

TEST_CASE("cells: an inheritance has the weight of effective samples, in all modes") {
  Inheritance inheritance;
  inheritance.triplets = {{kOtherMode, {component_at({0, 0, 0}, 1)}}};
  FitRule rule;
  rule.inherit = 3;
  Reservoir reservoir(8);
  RandomStream random(1);
  // Without samples the inheritance remains. Without inheritance nothing is known.
  const CellFit empty = fit_cell(reservoir, kCell, rule, inheritance);
  REQUIRE(empty.knowledge.triplets.size() == 1);
  CHECK(empty.knowledge.triplets[0].mode == kOtherMode);
  CHECK(empty.knowledge.triplets[0].components[0].weight == doctest::Approx(1));
  CHECK(empty.knowledge.triplets[0].components[0].mean[3] == doctest::Approx(0));
  CHECK(empty.knowledge.share == 0);
  CHECK(fit_cell(reservoir, kCell, rule).knowledge.triplets.empty());
  // Two samples of weight 7 in one mode, three inherited ones in the other.
  for (const float offset : {0.0f, 0.1f}) {
    reservoir.insert(triplet_of(kMode, offset), 7, random);
  }
  const CellFit fit = fit_cell(reservoir, kCell, rule, inheritance);
  REQUIRE(fit.knowledge.triplets.size() == 2);
  CHECK(fit.knowledge.triplets[0].components[0].weight == doctest::Approx(2.0 / 5));
  CHECK(fit.knowledge.triplets[1].components[0].weight == doctest::Approx(3.0 / 5));
  CHECK(fit.knowledge.share == doctest::Approx(14));
}

TEST_CASE("cells: with a single sample, the correlation is known from the inheritance alone") {
  // The vertices of the inherited component shift together.
  Gaussian<9> gaussian{Vector<9>::Constant(3), 0.01 * Matrix<9>::Identity()};
  gaussian.mean.segment<3>(3).setZero();
  gaussian.covariance += covariance_of_shift<9>({.shift = 0.5, .shift_of_last = 0.5});
  Inheritance inheritance;
  inheritance.triplets = {{kMode, {make_component<6>(1, gaussian)}}};
  Reservoir reservoir(8);
  RandomStream random(1);
  reservoir.insert(triplet_of(kMode, 0.2f), 1, random);
  const auto covariance = [&](double inherit) {
    FitRule rule;
    rule.inherit = inherit;
    const CellFit fit = fit_cell(reservoir, kCell, rule, inherit > 0 ? inheritance : Inheritance{});
    REQUIRE(fit.knowledge.triplets[0].components.size() == 1);
    const Matrix<9> l = fit.knowledge.triplets[0].components[0].cholesky();
    return Matrix<9>(l * l.transpose());
  };
  CHECK(covariance(2).isApprox(gaussian.covariance, 1e-5));
  CHECK(covariance(0).isApprox(0.04 * Matrix<9>::Identity(), 1e-5));  // (0.1 edges of 2)^2
}

TEST_CASE("cells: an inheritance hardly counts among many samples") {
  Inheritance inheritance;
  inheritance.triplets = {{kMode, {component_at({0.5f, 0, 0}, 1)}}};
  FitRule rule;
  Reservoir reservoir(4096);
  RandomStream random(2);
  for (int i = 0; i < 4000; ++i) {
    Triplet triplet = triplet_of(kMode);
    for (Point3& p : triplet.vertices) p += 0.05f * Vec3{random.next_1d(), random.next_1d(), 0};
    reservoir.insert(triplet, 1, random);
  }
  const auto mean = [&](double inherit) {
    rule.inherit = inherit;
    const CellFit fit = fit_cell(reservoir, kCell, rule, inherit > 0 ? inheritance : Inheritance{});
    double weight = 0, sum = 0;
    for (const auto& c : fit.knowledge.triplets[0].components) {
      weight += c.weight;
      sum += c.weight * c.mean[3];
    }
    return sum / weight;
  };
  CHECK(mean(0) == doctest::Approx(0.025).epsilon(0.05));
  CHECK(std::abs(mean(10) - mean(0)) < 0.003);  // 10 / 4010 of a distance of 0.475, and rounding
  CHECK(mean(4000) > 0.2);
}

// --- learning ------------------------------------------------------------------------------------

/// Returns the model after an iteration of many paths and four of few. The cells are divided again
/// and again, so that some have no sample in the end.
std::shared_ptr<const VertexTripletsModel> after_divisions(double inherit) {
  const VertexTripletsLearner learner({.cells = 4096, .reservoir = 256, .inherit = inherit});
  const auto state = learner.begin(context());
  std::shared_ptr<const GuidingModel> model;
  for (std::uint32_t i = 0; i < 5; ++i) {
    state->absorb(mirror_paths(i == 0 ? 1000 : 100, 1 + i));
    model = state->update({i, 4 - i}).model;
  }
  return std::dynamic_pointer_cast<const VertexTripletsModel>(model);
}

TEST_CASE("learning: new cells without samples know the mirror from the cells they were part of") {
  const auto with = after_divisions(5), without = after_divisions(0);
  CHECK(with->info().regions == without->info().regions);
  CHECK(with->info().regions > 200);
  CHECK(mirror_error(*with, 1) < 0.02);
  CHECK(mirror_error(*without, 1) > 0.05);
}

VertexTripletsSettings all_options() {
  return {.cells = 16,
          .reservoir = 64,
          .inherit = 8,
          .translation = true,
          .light_samples = false,
          .weights = SampleWeights::relative};
}

TEST_CASE("learning: with all options the same for 1, 2 and 7 threads") {
  for (const auto vertices : {Prefix::pair, Prefix::triplet}) {
    VertexTripletsSettings settings = all_options();
    settings.vertices = vertices;
    std::string first;
    for (const int threads : {1, 2, 7}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      const auto model = learned(settings);
      if (first.empty()) first = saved(*model);
      CHECK(saved(*model) == first);
    }
  }
}

TEST_CASE("learning: saved and loaded, inheritance and pixels go on as before; damage is noticed") {
  const VertexTripletsLearner learner(all_options());
  const auto state = learner.begin(context());
  const auto resumed = [&](const std::string& text) {
    std::istringstream in(text);
    auto result = learner.begin(context());
    load(in, *result);
    return result;
  };
  for (std::uint32_t i = 0; i < 3; ++i) {
    state->absorb(mirror_paths(500, i));
    if (i < 2) state->update({i, 1});
  }
  const std::string bytes = saved(*state);
  const auto again = resumed(bytes);
  CHECK(saved(*again) == bytes);
  for (const auto* s : {&state, &again}) (*s)->absorb(mirror_paths(30, 9));
  CHECK(saved(*state->update({2, 0}).model) == saved(*again->update({2, 0}).model));
  RandomStream random(3);
  int noticed = 0;
  for (int i = 0; i < 300; ++i) {
    std::string changed = bytes;
    changed[random() % bytes.size()] = static_cast<char>(random());
    try {
      resumed(changed)->update({3, 0});
    } catch (const InputError&) {
      ++noticed;
    }
  }
  CHECK(noticed > 0);
}

TEST_CASE("learner: with paths from lights, only weights of paths are comparable") {
  for (const auto weights : {SampleWeights::suffix, SampleWeights::relative}) {
    CHECK_THROWS_AS(VertexTripletsLearner({.light_paths = true, .weights = weights}), InputError);
  }
  CHECK_NOTHROW(VertexTripletsLearner({.light_paths = true, .inherit = 4, .translation = true}));
}

}  // namespace
}  // namespace pharos::vertex_triplets
