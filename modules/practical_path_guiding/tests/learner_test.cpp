#include "../learner.h"

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>

#include "../model.h"

namespace pharos::practical_path_guiding {
namespace {

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
    log.begin_path({0.5f, 0.5f}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1), .local_weight = Rgb(1)});
    log.add(RecordedVertex{.position = from,
                           .event = Event::smooth_reflect,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(0.5f),
                           .direction = direction,
                           .unguided_pdf = hits ? 5.0f : 0.16f,
                           .guidable = true});
    log.add(RecordedVertex{
        .position = from + direction, .parent = 1, .emission = Rgb(hits ? 20.0f : 0.1f)});
  }
  return log;
}

LearningContext context() {
  Bounds3 region;
  region.add(Point3{-1, -1, 0});
  region.add(Point3{1, 1, 1});
  return {.region = region, .seed = 7, .iterations = 4, .window = {0, 0, 10, 10}};
}

PracticalPathGuidingSettings small_settings() {
  return {.spatial_threshold = 100};
}

std::shared_ptr<const GuidingModel> trained(LearningState& state, int iterations = 4) {
  std::shared_ptr<const GuidingModel> model;
  for (int i = 0; i < iterations; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    state.absorb(lamp_paths(2000 << i, 2 * seed));
    state.absorb(lamp_paths(1000 << i, 2 * seed + 1));
    model = state.update(static_cast<std::uint32_t>(i), i + 1 == iterations);
  }
  return model;
}

std::shared_ptr<const GuidingModel> trained(const PracticalPathGuidingSettings& settings,
                                            int iterations = 4) {
  const auto state = PracticalPathGuidingLearner(settings).begin(context());
  return trained(*state, iterations);
}

const PracticalPathGuidingModel& as_tree(const std::shared_ptr<const GuidingModel>& model) {
  return dynamic_cast<const PracticalPathGuidingModel&>(*model);
}

template <class Savable>
std::string saved(const Savable& what) {
  std::ostringstream out;
  what.save(out);
  return out.str();
}

/// Returns the share of sampled directions at a point that are within 18 degrees of `direction`.
double share_near(const PracticalPathGuidingModel& tree, Point3 at, Vec3 direction) {
  RandomStream random(9);
  const QuadDensity density(tree.at(at).nodes);
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
        const auto model = trained(settings);
        const PracticalPathGuidingModel& tree = as_tree(model);
        for (const Point3 at : {Point3{0.5f, 0.5f, 0}, {-0.7f, 0.2f, 0}, {0.01f, 0.01f, 0}}) {
          CHECK(share_near(tree, at, normalize(kLamp - at)) > 0.5);
        }
        CHECK(tree.region_count() > 10);
      }
    }
  }
}

TEST_CASE("cells are halved where records are above the threshold, axis after axis") {
  PracticalPathGuidingSettings settings = small_settings();
  settings.spatial_filter = SpatialFilter::nearest;
  // 3000 records, 30 paths per pixel: the threshold is 100 sqrt(30 / 2) = 387. Each half is assumed
  // to have half of the records, also if the plane is across z and leaves one side without records.
  const auto model = trained(settings, 1);
  const PracticalPathGuidingModel& tree = as_tree(model);
  CHECK(tree.region_count() == 8);
  CHECK(tree.region_origins() == std::vector<std::uint32_t>(8, 0));
  settings.spatial_threshold = 1e9;
  CHECK(as_tree(trained(settings, 4)).region_count() == 1);
  settings.spatial_threshold = 1e-3;
  settings.spatial_depth = 5;
  CHECK(as_tree(trained(settings, 1)).region_count() == 32);
}

TEST_CASE("regions come from those of the model before") {
  const auto state = PracticalPathGuidingLearner(small_settings()).begin(context());
  std::uint32_t before = 1;
  for (std::uint32_t i = 0; i < 4; ++i) {
    state->absorb(lamp_paths(2000 << i, i));
    const auto model = state->update(i, false);
    REQUIRE(model->region_origins().size() == model->region_count());
    for (const std::uint32_t origin : model->region_origins()) CHECK(origin < before);
    before = model->region_count();
  }
}

TEST_CASE("the same bits for any number of threads") {
  std::string expected;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    PracticalPathGuidingSettings settings = small_settings();
    settings.target = GuidingTarget::relative;
    settings.batch_records = 1024;
    const std::string bits = saved(*trained(settings));
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
  whole->save(file);
  const auto resumed = learner.begin(context());
  resumed->load(file);
  CHECK(saved(*trained(*whole, 2)) == saved(*trained(*resumed, 2)));
}

TEST_CASE("merged states know what both absorbed") {
  PracticalPathGuidingSettings settings = small_settings();
  settings.spatial_filter = SpatialFilter::nearest;
  const PracticalPathGuidingLearner learner(settings);
  const auto whole = learner.begin(context()), part = learner.begin(context()),
             other = learner.begin(context());
  whole->absorb(lamp_paths(2000, 1));
  whole->absorb(lamp_paths(2000, 2));
  part->absorb(lamp_paths(2000, 1));
  other->absorb(lamp_paths(2000, 2));
  part->merge(*other);
  CHECK(saved(*whole->update(0, false)) == saved(*part->update(0, false)));
  CHECK_THROWS_AS(part->merge(*other), InputError);
}

TEST_CASE("a cell that finds nothing keeps what it knew; without light there is no model") {
  const auto state = PracticalPathGuidingLearner(small_settings()).begin(context());
  PathLog black;
  black.begin_path({}, Transport::radiance);
  black.add(RecordedVertex{.throughput = Rgb(1)});
  state->absorb(black);
  CHECK(state->update(0, false) == nullptr);
  state->absorb(lamp_paths(4000, 1));
  const auto before = state->update(1, false);
  const auto after = state->update(2, false);
  const Point3 at{0.5f, 0.5f, 0};
  CHECK(after->density(at, normalize(kLamp - at)) == before->density(at, normalize(kLamp - at)));
}

TEST_CASE("models survive being saved; damaged ones are refused or sound") {
  const PracticalPathGuidingLearner learner(small_settings());
  const auto model = trained(small_settings());
  const std::string file = saved(*model);
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
      CHECK(std::isfinite(loaded->density({0.1f, 0.2f, 0}, {0, 0, 1})));
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace pharos::practical_path_guiding
