#include "../learner.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

#include "../model.h"
#include "../seen_mixture.h"
#include "test_gaussians.h"

namespace pharos::spatial_gaussians {
namespace {

using namespace testing;
using test::saved;

/// The ends of a thin tube of light above a square floor.
constexpr Point3 kTubeBegin{-1, 1, 0.5f}, kTubeEnd{1, 1.2f, 0.5f};

/// Returns paths with one guidable step each. The steps start at random points of the floor and hit
/// either the tube or a dark wall. Every coordinate is multiplied by `scale`.
PathLog tube_paths(int count, std::uint64_t seed, float scale = 1) {
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d();
    const Point3 from{2 * u.x - 1, 0, 2 * u.y - 1};
    const bool hits = random.next_1d() < 0.3f;
    const float t = random.next_1d();
    const Point3 to = hits ? (1 - t) * kTubeBegin + t * kTubeEnd + 0.01f * any_direction(random)
                           : from + 3.0f * warp::cosine_hemisphere_from_square(random.next_2d());
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.position = scale * from,
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(1),
                           .direction = normalize(to - from),
                           .pdf = 0.3f});
    log.add(
        RecordedVertex{.position = scale * to, .parent = 1, .emission = Rgb(hits ? 1.0f : 0.0f)});
  }
  return log;
}

LearningContext context(float scale = 1) {
  Bounds3 region;
  region.add(scale * Point3{-1, 0, -1});
  region.add(scale * Point3{1, 2, 1});
  return {.region = region, .seed = 7};
}

SpatialGaussiansSettings small_settings() {
  SpatialGaussiansSettings settings;
  settings.cell_samples = 2000;
  settings.components = 4;
  settings.most_components = 8;
  settings.split_samples = 500;
  settings.merge_samples = 1000;
  return settings;
}

std::shared_ptr<const GuidingModel> trained(LearningState& state, std::uint32_t iterations = 4,
                                            float scale = 1) {
  std::shared_ptr<const GuidingModel> model;
  for (std::uint32_t i = 0; i < iterations; ++i) {
    const std::uint64_t seed = i;
    state.absorb(tube_paths(3000, 2 * seed, scale));
    state.absorb(tube_paths(2000, 2 * seed + 1, scale));
    model = state.update({i, iterations - 1 - i}).model;
  }
  return model;
}

std::shared_ptr<const GuidingModel> trained(const SpatialGaussiansSettings& settings,
                                            float scale = 1) {
  const auto state = SpatialGaussiansLearner(settings).begin(context(scale));
  return trained(*state, 4, scale);
}

const SpatialGaussiansModel& as_gaussians(const std::shared_ptr<const GuidingModel>& model) {
  return dynamic_cast<const SpatialGaussiansModel&>(*model);
}

/// Returns the density that the model expects from a direction at a point.
double density(const GuidingModel& model, Point3 at, Vec3 direction) {
  return model.density(at, &direction);
}

/// Returns the share of the model's directions at a point that pass the tube within this distance.
double share_near_tube(const SpatialGaussiansModel& model, Point3 at, float distance) {
  RandomStream random(11);
  const std::span<const SpatialGaussian> components = model.mixture_at(at);
  constexpr int kDraws = 2000;
  int near = 0;
  for (int i = 0; i < kDraws; ++i) {
    float choice = random.next_1d();
    std::size_t k = 0;
    while (k + 1 < components.size() && choice >= components[k].weight) {
      choice -= components[k++].weight;
    }
    const Vec3 w = normalize(point_of(components[k], at, random));
    // The distance between the line of the direction and the line of the tube.
    const Vec3 tube = normalize(kTubeEnd - kTubeBegin), normal = normalize(cross(w, tube));
    near += std::abs(dot(kTubeBegin - at, normal)) < distance ? 1 : 0;
  }
  return static_cast<double>(near) / kDraws;
}

TEST_CASE("mixtures learn where the light is, as a tree and as one") {
  for (const SpatialCells spatial : {SpatialCells::kdtree, SpatialCells::single}) {
    SpatialGaussiansSettings settings = small_settings();
    settings.spatial = spatial;
    const auto model = trained(settings);
    const SpatialGaussiansModel& gaussians = as_gaussians(model);
    CAPTURE(static_cast<int>(spatial));
    CHECK((gaussians.info().regions > 1) == (spatial == SpatialCells::kdtree));
    for (const Point3 at : {Point3{0, 0, 0}, Point3{0.7f, 0, -0.8f}, Point3{-0.5f, 0, 0.5f}}) {
      CHECK(share_near_tube(gaussians, at, 0.1f) > 0.9);
      const Vec3 to_tube = normalize(0.5f * (kTubeBegin + kTubeEnd) - at);
      CHECK(density(*model, at, to_tube) > 20 * density(*model, at, {0, 0, -1}));
    }
    CHECK(model->density(kTubeBegin) > 1e3 * model->density(Point3{0, 0.2f, 0}));
    float total = 0;
    for (const SpatialGaussian& g : gaussians.mixture_at(Point3{0, 0, 0})) {
      total += g.weight;
    }
    CHECK(total == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("cells are divided where samples are many, and say where they came from") {
  const auto state = SpatialGaussiansLearner(small_settings()).begin(context());
  std::uint32_t before = 1;
  for (std::uint32_t i = 0; i < 4; ++i) {
    state->absorb(tube_paths(5000, i));
    const auto [model, origins] = state->update({i, 3 - i});
    REQUIRE(origins.size() == model->info().regions);
    for (std::uint32_t cell = 0; cell < origins.size(); ++cell) {
      CHECK(origins[cell] < before);
      if (cell < before) CHECK(origins[cell] == cell);
    }
    before = model->info().regions;
  }
  CHECK(before > 4);
}

TEST_CASE("a fit uses few samples, and its last step uses all") {
  SpatialGaussiansSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  const auto with = [&settings](std::uint32_t fit_samples) {
    settings.fit_samples = fit_samples;
    return trained(settings);
  };
  // About 1,500 samples of each iteration have light.
  CHECK(saved(*with(2'000)) == saved(*with(1'000'000)));
  const auto model = with(100);
  CHECK(saved(*model) != saved(*with(1'000'000)));
  for (const Point3 at : {Point3{0, 0, 0}, Point3{0.7f, 0, -0.8f}}) {
    CHECK(share_near_tube(as_gaussians(model), at, 0.1f) > 0.9);
  }
  // With one component, one step suffices, so the result does not depend on the chosen samples.
  settings.components = settings.most_components = 1;
  const auto few = with(64), all = with(1'000'000);
  const SpatialGaussian& a = as_gaussians(few).mixture_at(Point3{})[0];
  const SpatialGaussian& b = as_gaussians(all).mixture_at(Point3{})[0];
  CHECK(length(a.mean - b.mean) < 1e-5f);
  for (int i = 0; i < 6; ++i) CHECK(a.cholesky[i] == doctest::Approx(b.cholesky[i]).epsilon(1e-3));
}

TEST_CASE("components of a mixture are split where directions ask for it, up to the limit") {
  SpatialGaussiansSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.components = 1;
  settings.merge_threshold = 0;
  // Two lights that one Gaussian cannot represent.
  const auto paths = [](std::uint64_t seed) {
    RandomStream random(seed);
    PathLog log;
    for (int i = 0; i < 5000; ++i) {
      const Point3 from = 0.1f * any_direction(random);
      const Point3 to = Point3{i % 2 == 0 ? -1.0f : 1.0f, 1, 0} + 0.05f * any_direction(random);
      log.begin_path({}, Transport::radiance);
      log.add(RecordedVertex{.throughput = Rgb(1)});
      log.add(RecordedVertex{.position = from,
                             .event = Event::smooth_reflect,
                             .guidable = true,
                             .parent = 0,
                             .direction = normalize(to - from),
                             .pdf = 30});
      log.add(RecordedVertex{.position = to, .parent = 1, .emission = Rgb(1)});
    }
    return log;
  };
  const auto state = SpatialGaussiansLearner(settings).begin(context());
  state->absorb(paths(1));
  const auto model = state->update({0, 0}).model;
  const auto components = as_gaussians(model).mixture_at(Point3{});
  CHECK(components.size() >= 2);
  CHECK(components.size() <= 8);
  for (const SpatialGaussian& g : components) CHECK(std::abs(std::abs(g.mean.x) - 1) < 0.2f);

  settings.split_threshold = 1e9;
  const auto whole = SpatialGaussiansLearner(settings).begin(context());
  whole->absorb(paths(1));
  CHECK(as_gaussians(whole->update({0, 0}).model).mixture_at(Point3{}).size() == 1);
}

TEST_CASE("splits and merges keep the weight of all") {
  SpatialGaussiansSettings settings = small_settings();
  settings.merge_threshold = 0.2;
  settings.split_threshold = 0.05;
  const auto state = SpatialGaussiansLearner(settings).begin(context());
  for (std::uint32_t i = 0; i < 4; ++i) {
    state->absorb(tube_paths(5000, i));
    const auto model = state->update({i, 3 - i}).model;
    for (const float x : {-0.9f, -0.3f, 0.2f, 0.8f}) {
      float total = 0;
      for (const SpatialGaussian& g : as_gaussians(model).mixture_at(Point3{x, 0, x})) {
        CHECK(g.weight > 0);
        total += g.weight;
      }
      CHECK(total == doctest::Approx(1).epsilon(1e-5));
    }
  }
}

/// Returns paths from a point to one of the targets. Each step has the same density.
template <class TargetOf>
PathLog paths_to(int count, TargetOf&& target_of) {
  RandomStream random(21);
  PathLog log;
  for (int i = 0; i < count; ++i) {
    const RecordedVertex end = target_of(i, random);
    const Point3 from = 0.01f * any_direction(random);
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.position = from,
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .direction = normalize(end.position - from),
                           .pdf = 10});
    RecordedVertex target = end;
    target.parent = 1;
    target.emission = Rgb(1);
    log.add(target);
  }
  return log;
}

TEST_CASE("a lamp that few samples have found stays small beside the sky") {
  SpatialGaussiansSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.components = 4;
  const auto state = SpatialGaussiansLearner(settings).begin(context());
  state->absorb(paths_to(40, [](int i, RandomStream& random) {
    if (i % 10 == 0)
      return RecordedVertex{.position = Point3{1, 1, 0} + 0.02f * any_direction(random)};
    const Vec3 up = normalize(Vec3{0, 1, 0} + 0.3f * any_direction(random));
    return RecordedVertex{.position = 5.0f * up, .kind = VertexKind::environment};
  }));
  const auto model = state->update({0, 0}).model;
  const SpatialGaussian* lamp = nullptr;
  for (const SpatialGaussian& g : as_gaussians(model).mixture_at(Point3{})) {
    if (length(g.mean - Point3{1, 1, 0}) < 0.1f) lamp = &g;
  }
  REQUIRE(lamp != nullptr);
  // The prior has a weight of 0.2 samples. With the variance of all targets, the lamp would be some
  // ten times as wide.
  CHECK(std::abs(lamp->cholesky[0]) < 0.1f);
}

TEST_CASE("a pair that directions want apart is not merged") {
  SpatialGaussiansSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  settings.components = 2;
  settings.most_components = 2;
  settings.merge_samples = 100;
  const auto learned = [&](double merge_threshold, double split_threshold) {
    settings.merge_threshold = merge_threshold;
    settings.split_threshold = split_threshold;
    const auto state = SpatialGaussiansLearner(settings).begin(context());
    state->absorb(paths_to(4000, [](int i, RandomStream& random) {
      return RecordedVertex{.position = Point3{i % 2 == 0 ? -0.115f : 0.115f, 1, 0} +
                                        0.1f * any_direction(random)};
    }));
    return saved(*state->update({0, 0}).model);
  };
  // Over space, a merge costs 0.3. A pair that is merged and split again would differ.
  CHECK(learned(0.5, 1e9) != learned(0, 1e9));
  CHECK(learned(0.5, 0.05) == learned(0, 0.05));
}

TEST_CASE("components that do the same are merged") {
  SpatialGaussiansSettings settings = small_settings();
  settings.spatial = SpatialCells::single;
  const auto count = [&] { return as_gaussians(trained(settings)).mixture_at(Point3{}).size(); };
  settings.components = 8;
  settings.split_threshold = 1e9;
  settings.merge_threshold = 0;
  CHECK(count() == 8);
  settings.merge_threshold = 0.025;
  CHECK(count() < 8);
}

TEST_CASE("models have the same bits for any number of threads") {
  const auto with_threads = [](std::size_t threads, SpatialCells spatial) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    SpatialGaussiansSettings settings = small_settings();
    settings.spatial = spatial;
    const auto state = SpatialGaussiansLearner(settings).begin(context());
    state->absorb(tube_paths(40'000, 77));  // enough for sums of several parts
    return saved(*trained(*state, 2));
  };
  for (const SpatialCells spatial : {SpatialCells::kdtree, SpatialCells::single}) {
    const std::string one = with_threads(1, spatial);
    for (const std::size_t threads : {2u, 3u, 7u}) CHECK(with_threads(threads, spatial) == one);
  }
}

TEST_CASE("a scene of another size learns the same") {
  const auto small = trained(small_settings(), 1.0f), large = trained(small_settings(), 1024.0f);
  const auto a = as_gaussians(small).mixture_at(Point3{});
  const auto b = as_gaussians(large).mixture_at(Point3{});
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    CHECK(a[k].weight == doctest::Approx(b[k].weight).epsilon(1e-4));
    CHECK(length(1024.0f * a[k].mean - b[k].mean) < 1e-2f);
    CHECK(b[k].cholesky[5] / 1024 == doctest::Approx(a[k].cholesky[5]).epsilon(1e-3));
  }
}

TEST_CASE("states that are saved and loaded go on as they would have") {
  const SpatialGaussiansLearner learner(small_settings());
  const auto straight = learner.begin(context()), first = learner.begin(context());
  trained(*straight, 2);
  trained(*first, 2);
  straight->absorb(tube_paths(100, 40));
  first->absorb(tube_paths(100, 40));
  std::istringstream file(saved(*first));
  const auto second = learner.begin(context());
  load(file, *second);
  for (LearningState* state : {straight.get(), second.get()}) state->absorb(tube_paths(5000, 41));
  CHECK(saved(*second->update({2, 0}).model) == saved(*straight->update({2, 0}).model));
}

TEST_CASE("models are saved and loaded, damaged ones are refused") {
  const auto model = trained(small_settings());
  const std::string file = saved(*model);
  const SpatialGaussiansLearner learner(small_settings());
  const auto loaded = [&](const std::string& bytes) {
    std::istringstream in(bytes);
    const auto empty = learner.empty_model();
    load(in, *empty);
    return empty;
  };
  CHECK(saved(*loaded(file)) == file);
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, file.size() / 2}) {
    CHECK_THROWS_AS(loaded(file.substr(0, length)), InputError);
  }
  RandomStream random(5);
  for (int i = 0; i < 200; ++i) {
    std::string broken = file;
    const auto at = static_cast<std::size_t>(random.next_1d() * static_cast<float>(file.size()));
    broken[at] = static_cast<char>(random() & 0xff);
    try {
      const auto damaged = loaded(broken);
      CHECK(std::isfinite(density(*damaged, {0, 0, 0}, {0, 1, 0})));
      Arena arena;
      const auto components = as_gaussians(damaged).mixture_at(Point3{0, 0, 0});
      const SeenMixture* seen = SeenMixture::make(components, {}, {}, Technique::exact, arena);
      if (seen != nullptr) CHECK(!std::isnan(seen->density({0, 1, 0})));
    } catch (const InputError&) {
    }
  }
}

TEST_CASE("nothing is known where nothing was found") {
  const SpatialGaussiansLearner learner(small_settings());
  const auto state = learner.begin(context());
  CHECK(state->update({0, 1}).model == nullptr);
  PathLog dark;
  dark.begin_path({}, Transport::radiance);
  dark.add(RecordedVertex{});
  dark.add(RecordedVertex{.guidable = true, .parent = 0, .direction = {0, 0, 1}, .pdf = 1});
  dark.add(RecordedVertex{.position = {0, 0, 1}, .parent = 1});
  state->absorb(dark);
  CHECK(state->update({1, 0}).model == nullptr);
}

TEST_CASE("rare finds add up to a first mixture, and cells wait for it before they are divided") {
  SpatialGaussiansSettings settings = small_settings();
  settings.cell_samples = 64;
  const auto state = SpatialGaussiansLearner(settings).begin(context());
  std::shared_ptr<const GuidingModel> model;
  int updates = 0;
  while (model == nullptr && updates < 20) {
    // Each batch has about five samples with light.
    state->absorb(tube_paths(17, static_cast<std::uint64_t>(updates)));
    model = state->update({static_cast<std::uint32_t>(updates++), 1}).model;
  }
  REQUIRE(model != nullptr);
  CHECK(updates > 3);
  CHECK(!as_gaussians(model).mixture_at(Point3{}).empty());
}

TEST_CASE("samples that are too many to wait are learned from before the iteration ends") {
  SpatialGaussiansSettings settings = small_settings();
  settings.batch_samples = 4000;
  const auto state = SpatialGaussiansLearner(settings).begin(context());
  for (std::uint64_t i = 0; i < 5; ++i) state->absorb(tube_paths(3000, i));
  CHECK(saved(*state).size() < 32 * 4000 + 40'000);
  const auto [model, origins] = state->update({0, 0});
  CHECK(share_near_tube(as_gaussians(model), Point3{0, 0, 0}, 0.1f) > 0.9);
  REQUIRE(origins.size() == model->info().regions);
  for (const std::uint32_t origin : origins) CHECK(origin == 0);
}

TEST_CASE("samples that all begin at one point do not divide cells for ever") {
  const auto state = SpatialGaussiansLearner(small_settings()).begin(context());
  RandomStream random(9);
  PathLog log;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 w = any_direction(random);
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{});
    log.add(RecordedVertex{.position = {0.5f, 0.5f, 0.5f},
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .direction = w,
                           .pdf = warp::sphere_pdf()});
    log.add(
        RecordedVertex{.position = Point3{0.5f, 0.5f, 0.5f} + w, .parent = 1, .emission = Rgb(1)});
  }
  state->absorb(log);
  CHECK(state->update({0, 0}).model->info().regions == 1);
}

TEST_CASE("settings that contradict each other are refused") {
  SpatialGaussiansSettings settings;
  settings.components = 40;
  CHECK_THROWS_AS(SpatialGaussiansLearner{settings}, InputError);
}

}  // namespace
}  // namespace pharos::spatial_gaussians
