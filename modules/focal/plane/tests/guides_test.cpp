#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>

#include "../experiment.h"
#include "../focal_guide.h"
#include "../path_space_guide.h"
#include "angle_fit.h"

namespace pharos::focal::plane {
namespace {

const GapScene kScene;
constexpr double kFraction = 0.5;

struct Named {
  std::string name;
  Guide* guide;
};

/// Guides of every kind, trained with a seed.
struct Trained {
  explicit Trained(std::uint64_t seed, const TrainingPlan& plan = {}) {
    for (const Named& named : all) train(*named.guide, kScene, plan, seed);
  }

  PathSpaceGuide path_space{kScene.light_height};
  PathSpaceGuide means{kScene.light_height, {.center = KernelCenter::neighbors}};
  FocalGuide focal{kScene};
  std::vector<Named> all{
      {"path space", &path_space}, {"path space, neighbors' means", &means}, {"focal", &focal}};
};

const Trained& trained() {
  static const Trained guides(1);
  return guides;
}

/// Returns the mass of the tree within `distance` of the centers of the gaps.
double mass_near_gaps(const FocalGuide& guide, double distance) {
  double sum = 0;
  guide.tree().for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
    const Point2 middle{cell.low.x + 0.5 * cell.size.x, cell.low.y + 0.5 * cell.size.y};
    for (const Interval& gap : kScene.gaps()) {
      const double x = middle.x - 0.5 * (gap.low + gap.high);
      if (std::hypot(x, middle.y - kScene.obstacle_height) < distance) sum += leaf.mass;
    }
  });
  return sum;
}

}  // namespace

TEST_CASE("plane guides: samples follow the densities, which integrate to one") {
  std::vector<double> p_values;
  std::uint64_t seed = 17;
  for (const Named& named : trained().all) {
    for (const double x : {-0.93, 0.0, 0.41}) {
      CAPTURE(named.name);
      CAPTURE(x);
      const testing::AngleFit fit = testing::fit_angles(*named.guide->at(x), seed++);
      CHECK(fit.integral == doctest::Approx(1).epsilon(5e-4));
      p_values.push_back(fit.p_value);
    }
    const testing::AngleFit mixed =
        testing::fit_angles(MixedDensity(named.guide->at(0.2), kFraction), seed++);
    CHECK(mixed.integral == doctest::Approx(1).epsilon(5e-4));
    p_values.push_back(mixed.p_value);
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("plane guides: normal numbers are normal") {
  RandomStream random(4);
  constexpr int kDraws = 200'000, kCells = 100;
  std::vector<double> observed(kCells), expected(kCells, double{kDraws} / kCells);
  for (int i = 0; i < kDraws; ++i) {
    const double below = 0.5 * std::erfc(-normal_number(random) / std::numbers::sqrt2);
    ++observed[std::min(static_cast<std::size_t>(below * kCells), std::size_t{kCells - 1})];
  }
  CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-3);
}

TEST_CASE("plane guides: estimates agree with the irradiance in closed form") {
  constexpr int kSamples = 16384;
  const double expected = kScene.mean_irradiance();
  RandomStream unguided(7);
  const MonteCarloMean uniform = estimate_irradiance(kScene, {}, 10 * kSamples, unguided);
  CHECK(std::abs(uniform.value - expected) < 4 * uniform.standard_error);
  for (const Named& named : trained().all) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(named.name);
      CAPTURE(seed);
      RandomStream random(seed, 2);
      const MonteCarloMean mean =
          estimate_irradiance(kScene, {named.guide, kFraction}, kSamples, random);
      CHECK(std::abs(mean.value - expected) < 4 * mean.standard_error);
    }
  }
  // The test would detect a bias of 3 % in the focal guide's pooled estimate at four standard
  // errors.
  RandomStream random(9);
  const MonteCarloMean pooled =
      estimate_irradiance(kScene, {&trained().focal, kFraction}, 8 * kSamples, random);
  CHECK(std::abs(pooled.value - expected) < 4 * pooled.standard_error);
  CHECK(4 * pooled.standard_error < 0.03 * expected);
}

TEST_CASE("plane guides: irradiance and variance at points of the floor") {
  constexpr int kSamples = 20'000;
  for (const Named& named : trained().all) {
    for (const double x : {-0.8, 0.1, 0.55}) {
      CAPTURE(named.name);
      CAPTURE(x);
      const Technique technique{named.guide, kFraction};
      const MixedDensity density = technique.at(x);
      RandomStream random(23);
      std::vector<double> values;
      for (int i = 0; i < kSamples; ++i) {
        const double angle = density.sample(random);
        values.push_back(kScene.sees_light(x, angle) ? std::cos(angle) / density.pdf(angle) : 0);
      }
      const double variance = local_variance(kScene, technique, x);
      const statistics::SampleMoments moments = statistics::moments(values);
      const double mean = kScene.irradiance(x);
      CHECK(std::abs(moments.mean - mean) < 4 * std::sqrt(variance / kSamples));
      // The error of a sampled variance follows from the spread of squared deviations.
      for (double& v : values) v = (v - mean) * (v - mean);
      const statistics::SampleMoments squares = statistics::moments(values);
      CHECK(std::abs(squares.mean - variance) < 5 * std::sqrt(squares.variance / kSamples));
    }
  }
}

TEST_CASE("plane guides: the same seed gives the same guides, another one others") {
  const TrainingPlan plan{.iterations = 4, .samples = 1024};
  const Trained a(3, plan), b(3, plan), other(4, plan);
  for (std::size_t i = 0; i < a.all.size(); ++i) {
    CAPTURE(a.all[i].name);
    const auto profile = [&](const Trained& guides) {
      return variance_profile(kScene, {guides.all[i].guide, kFraction}, 16);
    };
    CHECK(profile(a) == profile(b));
    CHECK(profile(a) != profile(other));
  }
}

TEST_CASE("plane guides: both beat uniform sampling by far") {
  const double uniform = evenness(variance_profile(kScene, {}, 128)).mean;
  const auto gain = [&](const Guide& guide) {
    return uniform / evenness(variance_profile(kScene, {&guide, kFraction}, 128)).mean;
  };
  CHECK(gain(trained().path_space) > 8);
  CHECK(gain(trained().focal) > 20);
}

TEST_CASE("plane guides: narrowing moves the mass into the gaps") {
  const auto mass = [](int narrowing_from) {
    FocalSettings settings;
    settings.narrowing_from = narrowing_from;
    FocalGuide guide(kScene, settings);
    train(guide, kScene, {}, 1);
    return mass_near_gaps(guide, 0.02);
  };
  CHECK(mass(3) > 0.8);
  CHECK(mass(6) < 0.6);  // without narrowing
}

TEST_CASE("plane guides: a narrowed splat is the share that eq. 14 says") {
  FocalSettings settings;
  settings.narrowing_from = 0;
  FocalGuide guide(kScene, settings);
  const Ray ray({0.1, 0}, -0.2);
  // Only one line of an even tree carries light. Its leaves get masses in proportion to t1^2 -
  // t0^2, so the upper half of the line gets three times as much as the lower half.
  guide.learn(std::vector<Path>{{.x = 0.1, .angle = -0.2, .pdf = 0.7, .value = 2}}, 0);
  double lower = 0, upper = 0;
  guide.tree().for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
    (cell.low.y < 0.5 ? lower : upper) += leaf.mass;
  });
  CHECK(lower == doctest::Approx(0.25));
  CHECK(upper == doctest::Approx(0.75));
  settings.narrowing_from = 1;
  FocalGuide early(kScene, settings);
  early.learn(std::vector<Path>{{.x = 0.1, .angle = -0.2, .pdf = 0.7, .value = 2}}, 0);
  lower = 0;
  early.tree().for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
    if (cell.low.y < 0.5) lower += leaf.mass;
  });
  CHECK(lower == doctest::Approx(0.5));  // weights by length
}

TEST_CASE("plane guides: the focal guide splats values, before narrowing and after") {
  for (const int narrowing_from : {0, 1}) {
    FocalSettings settings;
    settings.narrowing_from = narrowing_from;
    FocalGuide guide(kScene, settings);
    guide.learn(std::vector<Path>{{-0.7, 0, 0.5, 1}, {0.6, 0, 0.5, 3}}, 0);
    double left = 0;
    guide.tree().for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
      if (cell.low.x < 0) left += leaf.mass;
    });
    CHECK(left == doctest::Approx(0.25));
  }
}

TEST_CASE("plane guides: too few paths are no guide") {
  PathSpaceGuide guide(kScene.light_height, {.neighbors = 3});
  std::vector<Path> paths{{0, 0, 1, 1}, {0.1, 0.1, 1, 1}};
  guide.learn(paths, 0);
  CHECK(guide.at(0) == nullptr);
  CHECK(MixedDensity(guide.at(0), kFraction).pdf(0.3) == doctest::Approx(1 / std::numbers::pi));
  paths.push_back({0.2, -0.1, 1, 1});
  guide.learn(paths, 1);
  CHECK(guide.at(0) != nullptr);
}

TEST_CASE("plane guides: accumulating keeps the paths of all iterations") {
  const std::vector<Path> paths(4, {0.3, 0.2, 1, 1});
  for (const bool accumulate : {false, true}) {
    PathSpaceGuide guide(kScene.light_height, {.neighbors = 3, .accumulate = accumulate});
    guide.learn(paths, 0);
    guide.learn(paths, 1);
    CHECK(guide.guide_paths().size() == (accumulate ? 8 : 4));
  }
}

TEST_CASE("plane guides: the median and the worst of a profile") {
  const Evenness even = evenness({4, 1, 3, 12});
  CHECK(even.mean == doctest::Approx(5));
  CHECK(even.worst_to_median == doctest::Approx(12 / 3.5));
  CHECK(evenness({5, 1, 2}).worst_to_median == doctest::Approx(2.5));
}

}  // namespace pharos::focal::plane
