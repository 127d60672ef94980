#include "../learner.h"

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

#include "../model.h"
#include "guided_paths.h"

namespace pharos::practical_path_guiding {
namespace {

using test::saved;

constexpr Point3 kLamp{0, 0, 1};

/// Returns paths with one guidable step each. The steps start at random points of a floor. Every
/// second one goes to a small bright ball around the lamp, the others are uniform over the
/// hemisphere.
PathLog lamp_paths(int count, std::uint64_t seed) {
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d();
    const Point3 from{2 * u.x - 1, 2 * u.y - 1, 0};
    Vec3 direction = warp::sphere_from_square(random.next_2d());
    direction.z = std::abs(direction.z);
    const bool hits = i % 2 == 0;
    if (hits) direction = normalize(kLamp + 0.05f * direction - from);
    add_step(log, {.position = from, .direction = direction, .pdf = hits ? 5.0f : 0.16f},
             Rgb(hits ? 20.0f : 0.1f));
  }
  return log;
}

LearningContext context() {
  Bounds3 region;
  region.add(Point3{-1, -1, 0});
  region.add(Point3{1, 1, 1});
  return {.region = region, .seed = 7, .window = {0, 0, 10, 10}};
}

PracticalPathGuidingSettings small_settings() {
  return {.spatial_threshold = 100};
}

/// Returns what the last of the iterations led to.
Learned trained(LearningState& state, std::uint32_t iterations = 4) {
  Learned learned;
  for (std::uint32_t i = 0; i < iterations; ++i) {
    const std::uint64_t seed = i;
    state.absorb(lamp_paths(2000 << i, 2 * seed));
    state.absorb(lamp_paths(1000 << i, 2 * seed + 1));
    learned = state.update({i, iterations - 1 - i});
  }
  return learned;
}

Learned trained(const PracticalPathGuidingSettings& settings, std::uint32_t iterations = 4) {
  const auto state = PracticalPathGuidingLearner(settings).begin(context());
  return trained(*state, iterations);
}

const PracticalPathGuidingModel& as_tree(const std::shared_ptr<const GuidingModel>& model) {
  return dynamic_cast<const PracticalPathGuidingModel&>(*model);
}

/// Returns the model that was saved. Throws InputError if it is damaged.
std::shared_ptr<const GuidingModel> loaded(const std::string& text) {
  std::istringstream in(text);
  const auto model = PracticalPathGuidingLearner(small_settings()).empty_model();
  load(in, *model);
  return model;
}

/// Returns the share of sampled directions at a point that are within 18 degrees of `direction`.
double share_near(const PracticalPathGuidingModel& tree, Point3 at, Vec3 direction) {
  RandomStream random(9);
  const QuadDensity density(tree.nodes(tree.place({.position = at}).region));
  constexpr int kDraws = 2000;
  int near = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 drawn = warp::sphere_from_square(density.sample(random.next_2d()));
    near += dot(drawn, direction) > 0.95f ? 1 : 0;
  }
  return static_cast<double>(near) / kDraws;
}

TEST_CASE("the guide finds the lamp, with every filter and target") {
  for (const GuidingTarget target :
       {GuidingTarget::radiance, GuidingTarget::product, GuidingTarget::relative}) {
    for (const SpatialFilter spatial : {SpatialFilter::nearest, SpatialFilter::stochastic}) {
      for (const auto filter : {DirectionalFilter::nearest, DirectionalFilter::box}) {
        CAPTURE(static_cast<int>(target));
        PracticalPathGuidingSettings settings = small_settings();
        settings.spatial_threshold = 20;
        settings.target = target;
        settings.spatial_filter = spatial;
        settings.directional_filter = filter;
        const auto model = trained(settings).model;
        const PracticalPathGuidingModel& tree = as_tree(model);
        for (const Point3 at : {Point3{0.5f, 0.5f, 0}, {-0.7f, 0.2f, 0}, {0.01f, 0.01f, 0}}) {
          CHECK(share_near(tree, at, normalize(kLamp - at)) > 0.5);
        }
        CHECK(tree.info().regions > 10);
      }
    }
  }
}

TEST_CASE("cells are halved where records are above the threshold, axis after axis") {
  PracticalPathGuidingSettings settings = small_settings();
  settings.spatial_filter = SpatialFilter::nearest;
  // 3000 records, 30 paths per pixel: the threshold is 100 sqrt(30 / 4) = 274. Each half is assumed
  // to have half of the records, also if the plane is across z and leaves one side without records.
  const Learned learned = trained(settings, 1);
  CHECK(learned.model->info().regions == 16);
  CHECK(learned.region_origins == std::vector<std::uint32_t>(16, 0));
  settings.spatial_threshold = 1e9;
  CHECK(trained(settings, 4).model->info().regions == 1);
  settings.spatial_threshold = 1e-3;
  settings.spatial_depth = 5;
  CHECK(trained(settings, 1).model->info().regions == 32);
}

TEST_CASE("regions come from those of the model before") {
  const auto state = PracticalPathGuidingLearner(small_settings()).begin(context());
  std::uint32_t before = 1;
  for (std::uint32_t i = 0; i < 4; ++i) {
    state->absorb(lamp_paths(2000 << i, i));
    const Learned learned = state->update({i, 1});
    REQUIRE(learned.region_origins.size() == learned.model->info().regions);
    for (const std::uint32_t origin : learned.region_origins) CHECK(origin < before);
    before = learned.model->info().regions;
  }
}

TEST_CASE("the same bits for any number of threads") {
  std::string expected;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    PracticalPathGuidingSettings settings = small_settings();
    settings.target = GuidingTarget::relative;
    settings.batch_records = 1024;
    const std::string bits = saved(*trained(settings).model);
    if (expected.empty()) expected = bits;
    CHECK(bits == expected);
  }
}

TEST_CASE("saved learning goes on as if it had not been interrupted") {
  const PracticalPathGuidingLearner learner(small_settings());
  const auto whole = learner.begin(context());
  trained(*whole, 2);
  whole->absorb(lamp_paths(500, 77));
  std::stringstream file;
  save(file, *whole);
  const auto resumed = learner.begin(context());
  load(file, *resumed);
  CHECK(saved(*trained(*whole, 2).model) == saved(*trained(*resumed, 2).model));
}

TEST_CASE("a cell that finds nothing keeps what it knew; without light there is no model") {
  const auto state = PracticalPathGuidingLearner(small_settings()).begin(context());
  PathLog black;
  black.begin_path({}, Transport::radiance);
  black.add(RecordedVertex{.throughput = Rgb(1)});
  state->absorb(black);
  CHECK(state->update({0, 1}).model == nullptr);
  state->absorb(lamp_paths(4000, 1));
  const auto before = state->update({1, 1}).model;
  const auto after = state->update({2, 1}).model;
  const Point3 at{0.5f, 0.5f, 0};
  const Vec3 to_lamp = normalize(kLamp - at);
  CHECK(after->density(at, &to_lamp) == before->density(at, &to_lamp));
}

TEST_CASE("with a memory, earlier iterations count as much as they are told to") {
  const Point3 at{0.5f, 0.5f, 0};
  for (const double memory : {0.0, 0.5, 1.0}) {
    PracticalPathGuidingSettings settings = small_settings();
    settings.spatial_depth = 0;
    settings.memory = memory;
    const auto state = PracticalPathGuidingLearner(settings).begin(context());
    Learned learned;
    for (std::uint32_t i = 0; i < 3; ++i) {
      state->absorb(lamp_paths(1000, i));
      learned = state->update({i, 2 - i});
    }
    CHECK(as_tree(learned.model).place({.position = at}).evidence ==
          doctest::Approx(1000 * (1 + memory + memory * memory)));
  }
}

TEST_CASE("halves of a cell have half of its memory each") {
  PracticalPathGuidingSettings settings = small_settings();
  settings.memory = 1;
  const auto state = PracticalPathGuidingLearner(settings).begin(context());
  state->absorb(lamp_paths(3000, 1));
  REQUIRE(state->update({0, 1}).model->info().regions == 16);
  // Nothing new was found, so that each of the sixteen cells knows what it got.
  const auto model = state->update({1, 0}).model;
  CHECK(as_tree(model).place({.position = {0.5f, 0.5f, 0}}).evidence == doctest::Approx(187.5));
}

/// Returns paths with one guidable step each. Radiance (1, 2, 6) arrives from all directions within
/// 60 degrees of +z. Half of the steps are uniform over these directions, half over all directions.
/// Each stands for `steps` steps.
PathLog cone_paths(int count, std::uint64_t seed, float steps = 1) {
  constexpr float kVersine = 0.5f;  // 1 - cos 60 degrees
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d(), v = random.next_2d();
    const Vec3 direction =
        i % 2 == 0 ? warp::cone_from_square(v, kVersine) : warp::sphere_from_square(v);
    const bool is_lit = direction.z > 1 - kVersine;
    const float cone_pdf = is_lit ? warp::cone_pdf(kVersine) : 0;
    add_step(log,
             {.position = {2 * u.x - 1, 2 * u.y - 1, 0},
              .direction = direction,
              .pdf = 0.5f * (cone_pdf + warp::sphere_pdf()),
              .continuation = steps},
             is_lit ? Rgb(1, 2, 6) : Rgb());
  }
  return log;
}

TEST_CASE("a model of radiance says how much arrives") {
  const auto state = PracticalPathGuidingLearner(small_settings()).begin(context());
  for (std::uint64_t i = 0; i < 5; ++i) state->absorb(cone_paths(20'000, i));
  const auto learned = state->update({0, 0}).model;
  REQUIRE(learned->info().regions > 1);
  for (const auto& model : {learned, loaded(saved(*learned))}) {
    const RadianceEstimate& estimate = as_tree(model);
    CHECK(estimate.radiance_traits().incident);
    CHECK(!estimate.radiance_traits().outgoing);
    for (const Point3 at : {Point3{0.5f, 0.5f, 0}, {-0.7f, 0.2f, 0}, {0.01f, 0.01f, 0}}) {
      // Each leaf has about 980 records with light: the standard deviation is below 3.2 %.
      for (const Vec3 w : {Vec3{0, 0, 1}, {0.3f, 0.2f, 1}, {-0.4f, 0.5f, 1}, {0, -0.6f, 1}}) {
        CHECK(estimate.incident_radiance(at, normalize(w)) ==
              doctest::Approx(3).epsilon(0.12).scale(0));
      }
      CHECK(estimate.incident_radiance(at, {0, 0, -1}) == 0);
      CHECK(estimate.incident_radiance(at, {1, 0, 0}) == 0);
    }
  }
}

TEST_CASE("survivors of roulette and branches say the same of how much arrives") {
  for (const float steps : {0.25f, 4.0f}) {
    CAPTURE(steps);
    const auto state = PracticalPathGuidingLearner(small_settings()).begin(context());
    for (std::uint64_t i = 0; i < 5; ++i) state->absorb(cone_paths(20'000, i, steps));
    const auto model = state->update({0, 0}).model;
    CHECK(as_tree(model).incident_radiance({0.5f, 0.5f, 0}, {0, 0, 1}) ==
          doctest::Approx(3).epsilon(0.12).scale(0));
  }
}

TEST_CASE("models of other targets, and those that know nothing, say nothing of radiance") {
  for (const GuidingTarget target : {GuidingTarget::product, GuidingTarget::relative}) {
    PracticalPathGuidingSettings settings = small_settings();
    settings.target = target;
    const auto learned = trained(settings, 1).model;
    CHECK(!as_tree(learned).radiance_traits().incident);
    CHECK(!as_tree(loaded(saved(*learned))).radiance_traits().incident);
  }
  CHECK(PracticalPathGuidingModel().incident_radiance({}, {0, 0, 1}) == 0);
}

TEST_CASE("records wait until the iteration or learning ends") {
  const auto state = PracticalPathGuidingLearner(small_settings()).begin(context());
  const std::size_t before = saved(*state).size();
  state->absorb(lamp_paths(1500, 1));
  CHECK(saved(*state).size() > before + 1500 * sizeof(Vec3));
  state->end_learning();
  CHECK(saved(*state).size() == before);
}

TEST_CASE("models survive being saved; damaged ones are refused or sound") {
  const std::string file = saved(*trained(small_settings()).model);
  CHECK(saved(*loaded(file)) == file);
  RandomStream random(1);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = file;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    if (i % 5 == 0) damaged.resize(random() % damaged.size());
    try {
      const auto model = loaded(damaged);
      const Vec3 up{0, 0, 1};
      CHECK(std::isfinite(model->density({0.1f, 0.2f, 0}, &up)));
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace pharos::practical_path_guiding
