#include "../learner.h"

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "../model.h"
#include "../sample.h"
#include "../seen_lobes.h"
#include "test_lobes.h"

namespace pharos::parallax_aware_mixtures {
namespace {

using namespace testing;
using test::saved;

constexpr Point3 kLamp{0, 0, 1};

/// Returns paths with one guidable step each. The steps start at random points of a floor. Every
/// third one hits a small lamp above the floor, the others hit dark walls.
PathLog lamp_paths(int count, std::uint64_t seed) {
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d();
    const Point3 from{2 * u.x - 1, 2 * u.y - 1, 0};
    const bool hits = i % 3 == 0;
    Vec3 aside = any_direction(random);
    aside.z = std::abs(aside.z);
    const Point3 to = hits ? kLamp + 0.03f * aside : from + 3 * aside;
    // About the density of directions if a third of all samples are uniform on a disk of that size.
    const float lamp_pdf = length_squared(to - from) / (3 * kPi * 0.03f * 0.03f);
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.position = from,
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .local_weight = Rgb(1),
                           .direction = normalize(to - from),
                           .pdf = hits ? lamp_pdf : 0.1f});
    log.add(RecordedVertex{.position = to, .parent = 1, .emission = Rgb(hits ? 5.0f : 0.0f)});
  }
  return log;
}

ParallaxAwareMixturesSettings small_settings() {
  ParallaxAwareMixturesSettings settings;
  settings.cell_samples = 4000;
  settings.components = 8;
  settings.most_components = 16;
  settings.split_samples = 500;
  settings.merge_samples = 1000;
  return settings;
}

/// Returns what the last of the iterations led to.
Learned trained(LearningState& state, std::uint32_t iterations = 4) {
  Learned learned;
  for (std::uint32_t i = 0; i < iterations; ++i) {
    state.absorb(lamp_paths(3000, 2 * i));
    state.absorb(lamp_paths(2000, 2 * i + 1));
    learned = state.update({i, iterations - 1 - i});
  }
  return learned;
}

Learned trained(const ParallaxAwareMixturesSettings& settings) {
  return trained(*ParallaxAwareMixturesLearner(settings).begin({.seed = 7}));
}

/// Returns the model that was saved. Throws InputError if it is damaged.
std::shared_ptr<const GuidingModel> loaded(const std::string& text) {
  std::istringstream in(text);
  const auto model = ParallaxAwareMixturesLearner(small_settings()).empty_model();
  load(in, *model);
  return model;
}

/// Returns the lobes of the cell around a point, as seen from the cell's pivot.
std::span<const LobeGroup> groups_at(const GuidingModel& model, Point3 at) {
  const auto& mixtures = dynamic_cast<const ParallaxAwareMixturesModel&>(model);
  return mixtures.groups(mixtures.place({.position = at}).region);
}

/// Returns the lobes as seen from a point; null if nothing is known there.
const SeenLobes* seen_from(const GuidingModel& model, Point3 at, Arena& arena) {
  const auto& mixtures = dynamic_cast<const ParallaxAwareMixturesModel&>(model);
  const std::uint32_t cell = mixtures.place({.position = at}).region;
  return SeenLobes::make(mixtures.groups(cell), mixtures.offset(cell, at), {}, arena);
}

/// Returns the share of sampled directions at a point that are within 5 degrees of the lamp.
double share_at_lamp(const GuidingModel& model, Point3 at) {
  Arena arena;
  const SeenLobes* seen = seen_from(model, at, arena);
  RandomStream random(9);
  constexpr int kDraws = 2000;
  int near = 0;
  for (int i = 0; i < kDraws; ++i) {
    const float choice = random.next_1d();
    near += dot(seen->sample(choice, random.next_2d()), normalize(kLamp - at)) > 0.996f ? 1 : 0;
  }
  return static_cast<double>(near) / kDraws;
}

double least_share(const GuidingModel& model) {
  double least = 1;
  for (const Point3 at : {Point3{0.9f, 0.9f, 0}, {-0.7f, 0.2f, 0}, {0.01f, 0.01f, 0}}) {
    least = std::min(least, share_at_lamp(model, at));
  }
  return least;
}

TEST_CASE("a single mixture points at the lamp from everywhere, thanks to parallax alone") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  CHECK(least_share(*trained(settings).model) > 0.7);
  settings.parallax = false;
  CHECK(least_share(*trained(settings).model) < 0.3);
}

TEST_CASE("a tree of mixtures finds the lamp, and its cells are divided") {
  const Learned learned = trained(small_settings());
  CHECK(least_share(*learned.model) > 0.7);
  CHECK(learned.model->info().regions > 3);
  REQUIRE(learned.region_origins.size() == learned.model->info().regions);
}

TEST_CASE("superfluous lobes are merged") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.most_components = settings.components;  // no splits
  const auto lobes = [&] { return std::stoi(trained(settings).model->info().facts[1].value); };
  const int merged = lobes();
  settings.merge_threshold = 0;
  CHECK(lobes() == 8);
  CHECK(merged < 8);
}

TEST_CASE("the halves of a lobe know how far away its light is") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.components = 1;
  const auto model = trained(settings).model;
  int lobes = 0;
  for (const LobeGroup& group : groups_at(*model, {0, 0, 0})) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (group.weight[i] == 0) continue;
      ++lobes;
      CHECK(group.inverse_distance[i] > 0.2f);
      CHECK(group.inverse_distance[i] < 2);
    }
  }
  CHECK(lobes > 2);
}

TEST_CASE("a wide light takes several lobes: those that fit badly are split") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.components = 1;
  settings.most_components = 12;
  PathLog log;
  RandomStream random(3);
  for (int i = 0; i < 20'000; ++i) {
    // A ring of light around a single point.
    const float phi = 2 * kPi * random.next_1d();
    const bool hits = i % 2 == 0;
    const Vec3 w = hits ? normalize(Vec3{std::cos(phi), std::sin(phi), 0.3f * random.next_1d()})
                        : any_direction(random);
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .local_weight = Rgb(1),
                           .direction = w,
                           .pdf = 0.2f});
    log.add(RecordedVertex{.position = 2 * w, .parent = 1, .emission = Rgb(hits ? 1.0f : 0.0f)});
  }
  const auto state = ParallaxAwareMixturesLearner(settings).begin({.seed = 7});
  state->absorb(log);
  const auto model = state->update({0, 0}).model;
  CHECK(std::stoi(model->info().facts[1].value) > 3);
  const Vec3 on_ring = normalize(Vec3{1, 1, 0.2f}), up{0, 0, 1};
  CHECK(model->density({}, &on_ring) > 4 * model->density({}, &up));
}

TEST_CASE("a fit uses few samples, and its last step uses all") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  const auto with = [&settings](std::uint32_t fit_samples) {
    settings.fit_samples = fit_samples;
    return trained(settings).model;
  };
  // About 1,700 samples of each iteration have light.
  CHECK(saved(*with(2'000)) == saved(*with(1'000'000)));
  const auto model = with(100);
  CHECK(saved(*model) != saved(*with(1'000'000)));
  CHECK(least_share(*model) > 0.7);
  // With one lobe, one step suffices, so the result does not depend on the chosen samples.
  settings.components = settings.most_components = 1;
  settings.parallax = false;
  const auto few = with(64), all = with(1'000'000);
  for (const Vec3 w : {Vec3{0, 0, 1}, normalize(Vec3{1, 0, 1}), normalize(Vec3{0, -1, 2})}) {
    CHECK(few->density({}, &w) == doctest::Approx(all->density({}, &w)).epsilon(1e-5));
  }
}

TEST_CASE("the same bits for any number of threads") {
  std::string expected;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::string bits = saved(*trained(small_settings()).model);
    if (expected.empty()) expected = bits;
    CHECK(bits == expected);
  }
}

TEST_CASE("saved learning goes on as if it had not been interrupted") {
  const ParallaxAwareMixturesLearner learner(small_settings());
  const auto whole = learner.begin({.seed = 7});
  trained(*whole, 2);
  whole->absorb(lamp_paths(500, 77));
  std::stringstream file;
  save(file, *whole);
  const auto resumed = learner.begin({.seed = 7});
  load(file, *resumed);
  CHECK(saved(*trained(*whole, 2).model) == saved(*trained(*resumed, 2).model));
}

TEST_CASE("samples wait until the iteration or learning ends, unless there are too many") {
  const auto bytes = [](std::uint32_t batch_samples, bool ends) {
    ParallaxAwareMixturesSettings settings = small_settings();
    settings.batch_samples = batch_samples;
    const auto state = ParallaxAwareMixturesLearner(settings).begin({.seed = 7});
    state->absorb(lamp_paths(1500, 1));
    if (ends) state->end_learning();
    return saved(*state).size();
  };
  CHECK(bytes(2000, false) > 1500 * sizeof(Sample));
  CHECK(bytes(1024, false) < bytes(2000, false) / 2);
  CHECK(bytes(2000, true) < 500 * sizeof(Sample));
}

TEST_CASE("little light waits for more; without any there is no model") {
  const auto state = ParallaxAwareMixturesLearner(small_settings()).begin({.seed = 7});
  CHECK(state->update({0, 1}).model == nullptr);
  state->absorb(lamp_paths(60, 1));  // 20 samples with light; a first fit needs 128
  CHECK(state->update({1, 1}).model == nullptr);
  state->absorb(lamp_paths(400, 2));
  CHECK(state->update({2, 1}).model != nullptr);
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
      const Point3 at{0.1f, 0.2f, 0};
      const Vec3 up{0, 0, 1};
      CHECK(std::isfinite(model->density(at, &up)));
      Arena arena;
      const SeenLobes* seen = seen_from(*model, at, arena);
      if (seen == nullptr) continue;
      const Vec3 drawn = seen->sample(random.next_1d(), random.next_2d());
      CHECK(length(drawn) == doctest::Approx(1).epsilon(1e-3));
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace pharos::parallax_aware_mixtures
