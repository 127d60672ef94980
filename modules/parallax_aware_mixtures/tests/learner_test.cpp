#include "../learner.h"

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>

#include "../model.h"
#include "../seen_lobes.h"
#include "test_lobes.h"

namespace pharos::parallax_aware_mixtures {
namespace {

using namespace testing;

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
                           .parent = 0,
                           .local_weight = Rgb(1),
                           .direction = normalize(to - from),
                           .unguided_pdf = hits ? lamp_pdf : 0.1f,
                           .guidable = true});
    log.add(RecordedVertex{.position = to, .parent = 1, .emission = Rgb(hits ? 5.0f : 0.0f)});
  }
  return log;
}

ParallaxAwareMixturesSettings small_settings() {
  return {.cell_samples = 4000,
          .components = 8,
          .most_components = 16,
          .split_samples = 500,
          .merge_samples = 1000};
}

std::shared_ptr<const GuidingModel> trained(LearningState& state, int iterations = 4) {
  std::shared_ptr<const GuidingModel> model;
  for (int i = 0; i < iterations; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    state.absorb(lamp_paths(3000, 2 * seed));
    state.absorb(lamp_paths(2000, 2 * seed + 1));
    model = state.update(static_cast<std::uint32_t>(i), i + 1 == iterations);
  }
  return model;
}

std::shared_ptr<const GuidingModel> trained(const ParallaxAwareMixturesSettings& settings) {
  return trained(*ParallaxAwareMixturesLearner(settings).begin({.seed = 7}));
}

template <class Savable>
std::string saved(const Savable& what) {
  std::ostringstream out;
  what.save(out);
  return out.str();
}

/// Returns the share of sampled directions at a point that are within 5 degrees of the lamp.
double share_at_lamp(const GuidingModel& model, Point3 at) {
  const auto view = dynamic_cast<const ParallaxAwareMixturesModel&>(model).at(at);
  Arena arena;
  const SeenLobes* seen = SeenLobes::make(view.groups, view.offset, {}, arena);
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
  CHECK(least_share(*trained(settings)) > 0.7);
  settings.parallax = false;
  CHECK(least_share(*trained(settings)) < 0.3);
}

TEST_CASE("a tree of mixtures finds the lamp, and its cells are divided") {
  const auto model = trained(small_settings());
  CHECK(least_share(*model) > 0.7);
  CHECK(model->region_count() > 3);
  REQUIRE(model->region_origins().size() == model->region_count());
}

TEST_CASE("superfluous lobes are merged") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.most_components = settings.components;  // no splits
  const auto lobes = [&] { return std::stoi(trained(settings)->facts()[1].value); };
  const int merged = lobes();
  settings.merge_threshold = 0;
  CHECK(lobes() == 8);
  CHECK(merged < 8);
}

TEST_CASE("the halves of a lobe know how far away its light is") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.components = 1;
  const auto model = trained(settings);
  const auto view = dynamic_cast<const ParallaxAwareMixturesModel&>(*model).at({0, 0, 0});
  int lobes = 0;
  for (const LobeGroup& group : view.groups) {
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
                           .parent = 0,
                           .local_weight = Rgb(1),
                           .direction = w,
                           .unguided_pdf = 0.2f,
                           .guidable = true});
    log.add(RecordedVertex{.position = 2 * w, .parent = 1, .emission = Rgb(hits ? 1.0f : 0.0f)});
  }
  const auto state = ParallaxAwareMixturesLearner(settings).begin({.seed = 7});
  state->absorb(log);
  const auto model = state->update(0, true);
  CHECK(std::stoi(model->facts()[1].value) > 3);
  CHECK(model->density({}, normalize(Vec3{1, 1, 0.2f})) > 4 * model->density({}, {0, 0, 1}));
}

TEST_CASE("the same bits for any number of threads") {
  std::string expected;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::string bits = saved(*trained(small_settings()));
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
  whole->save(file);
  const auto resumed = learner.begin({.seed = 7});
  resumed->load(file);
  CHECK(saved(*trained(*whole, 2)) == saved(*trained(*resumed, 2)));
}

TEST_CASE("merged states know what both absorbed") {
  const ParallaxAwareMixturesLearner learner(small_settings());
  const auto whole = learner.begin({.seed = 7}), part = learner.begin({.seed = 7}),
             other = learner.begin({.seed = 7});
  whole->absorb(lamp_paths(2000, 1));
  whole->absorb(lamp_paths(2000, 2));
  part->absorb(lamp_paths(2000, 1));
  other->absorb(lamp_paths(2000, 2));
  part->merge(*other);
  CHECK(saved(*whole->update(0, false)) == saved(*part->update(0, false)));
  CHECK_THROWS_AS(part->merge(*other), InputError);
}

TEST_CASE("states that learned before the iteration's end are not merged") {
  ParallaxAwareMixturesSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.batch_samples = 1024;
  const ParallaxAwareMixturesLearner learner(settings);
  const auto one = learner.begin({.seed = 7}), other = learner.begin({.seed = 7});
  for (auto* state : {one.get(), other.get()}) state->absorb(lamp_paths(1500, 1));
  CHECK_THROWS_AS(one->merge(*other), InputError);
}

TEST_CASE("little light waits for more; without any there is no model") {
  const auto state = ParallaxAwareMixturesLearner(small_settings()).begin({.seed = 7});
  CHECK(state->update(0, false) == nullptr);
  state->absorb(lamp_paths(60, 1));  // 20 samples with light; a first fit needs 128
  CHECK(state->update(1, false) == nullptr);
  state->absorb(lamp_paths(400, 2));
  CHECK(state->update(2, false) != nullptr);
}

TEST_CASE("models survive being saved; damaged ones are refused or sound") {
  const ParallaxAwareMixturesLearner learner(small_settings());
  const std::string file = saved(*trained(small_settings()));
  std::istringstream in(file);
  CHECK(saved(*learner.load_model(in)) == file);
  RandomStream random(1);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = file;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    if (i % 5 == 0) damaged.resize(random() % damaged.size());
    std::istringstream stream(damaged);
    try {
      const auto loaded = learner.load_model(stream);
      const Point3 at{0.1f, 0.2f, 0};
      CHECK(std::isfinite(loaded->density(at, {0, 0, 1})));
      const auto view = dynamic_cast<const ParallaxAwareMixturesModel&>(*loaded).at(at);
      Arena arena;
      const SeenLobes* seen = SeenLobes::make(view.groups, view.offset, {}, arena);
      if (seen == nullptr) continue;
      const Vec3 drawn = seen->sample(random.next_1d(), random.next_2d());
      CHECK(length(drawn) == doctest::Approx(1).epsilon(1e-3));
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace pharos::parallax_aware_mixtures
