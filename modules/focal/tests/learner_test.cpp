#include "../learner.h"

#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/warp.h>

#include "../model.h"
#include "test_trees.h"

namespace pharos::focal {
namespace {

using namespace testing;

/// Half of the width of the hole through which all light passes, and the hole's center.
constexpr float kHole = 0.01f;
constexpr Point3 kCenter{0.1f, 1.1f, 3.9f};

/// Returns paths like those in a camera obscura. Each path has one guidable segment, from a random
/// point through the hole. Every coordinate is multiplied by `scale`.
PathLog hole_paths(int count, std::uint64_t seed, float scale = 1, Point3 center = kCenter,
                   float unguided_fraction = 0.5f) {
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    Point3 from = point_in_box(random, test_box());
    from.z = 2;
    const Vec3 direction = normalize(point_near(random, center, kHole) - from);
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.position = scale * from,
                           .event = Event::smooth_reflect,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(1),
                           .direction = direction,
                           .unguided_pdf = 0.3f,
                           .guided_pdf = 0.3f,
                           .unguided_fraction = unguided_fraction,
                           .guidable = true});
    log.add(RecordedVertex{
        .position = scale * (from + 4.0f * direction), .parent = 1, .emission = Rgb(1)});
  }
  return log;
}

LearningContext context(float scale = 1, std::uint32_t iterations = 10) {
  const Box box = test_box();
  Bounds3 region;
  for (const unsigned corner : {0u, 7u}) {
    Point3 p;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double far = (corner >> axis & 1) != 0 ? box.size[axis] : 0;
      p[static_cast<int>(axis)] = scale * static_cast<float>(box.low[axis] + far);
    }
    region.add(p);
  }
  return {region, 1, iterations};
}

/// Trains on `hole_paths` for all iterations.
std::shared_ptr<const FocalModel> trained(const FocalSettings& settings, float scale = 1,
                                          Point3 center = kCenter) {
  constexpr std::uint32_t iterations = 10;
  const auto state = FocalLearner(settings).begin(context(scale, iterations));
  std::shared_ptr<const GuidingModel> model = state->initial_model();
  for (std::uint32_t i = 0; i < iterations; ++i) {
    for (std::uint64_t unit = 0; unit < 3; ++unit) {
      state->absorb(hole_paths(1000, 10 * i + unit, scale, center));
    }
    model = state->update(i, i + 1 == iterations);
  }
  return std::dynamic_pointer_cast<const FocalModel>(model);
}

std::string saved(const GuidingModel& model) {
  std::ostringstream out;
  model.save(out);
  return out.str();
}
std::string saved(const LearningState& state) {
  std::ostringstream out;
  state.save(out);
  return out.str();
}

/// Returns the share of sampled directions from the canvas that pass through the hole.
double hits(const FocalModel& model, Point3 center = kCenter) {
  RandomStream random(99);
  constexpr int kDraws = 10'000;
  int through = 0;
  for (int i = 0; i < kDraws; ++i) {
    Point3 from = point_in_box(random, test_box());
    from.z = 2;
    const float sign = random.next_1d();
    const Vec2 u = random.next_2d();
    const auto w = model.focal_density().sample_direction(from, sign, u, random.next_1d());
    if (!w || w->z <= 0) continue;
    const Point3 p = from + (center.z - from.z) / w->z * *w;
    through += max_component(abs(p - center)) < kHole ? 1 : 0;
  }
  return static_cast<double>(through) / kDraws;
}

}  // namespace

TEST_CASE("focal learner: mass gathers in the hole, and narrowing gathers more of it") {
  const double wide = hits(*trained({.narrowing_iterations = 0}));
  const double narrow = hits(*trained({.narrowing_iterations = 5}));
  MESSAGE("share of directions through the hole: " << wide << ", narrowed " << narrow);
  CHECK(wide > 0.002);
  CHECK(narrow > 0.3);
  CHECK(narrow > 30 * wide);
}

TEST_CASE("focal learner: the region grows to a focal point outside of the scene") {
  constexpr Point3 kImage{0.4f, 1.6f, 9};
  const auto fixed = trained({}, 1, kImage), grown = trained({.region_growths = 3}, 1, kImage);
  const double before = hits(*fixed, kImage), after = hits(*grown, kImage);
  MESSAGE("share of directions through the image: " << before << ", with a region that grew "
                                                    << after);
  CHECK(!fixed->bounds().contains(kImage));
  CHECK(grown->bounds().contains(kImage));
  CHECK(after > 0.3);
  CHECK(after > 5 * before);
  // Focal points within the scene let the region grow at most once.
  const auto inside = trained({.region_growths = 3});
  CHECK(inside->bounds().diagonal() <= 2.001f * fixed->bounds().diagonal());
}

TEST_CASE("focal learner: the same model for any number of threads") {
  std::string first;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto state = FocalLearner(FocalSettings{}).begin(context(1, 2));
    state->absorb(hole_paths(150'000, 1));
    state->update(0, false);
    state->absorb(hole_paths(150'000, 2));
    const std::string bits = saved(*state->update(1, true));
    if (first.empty()) first = bits;
    CHECK(bits == first);
  }
}

TEST_CASE("focal learner: a scene scaled by a power of two gives the same tree") {
  const auto model = trained({});
  for (const float scale : {0x1p-10f, 0x1p12f}) {
    const auto scaled = trained({}, scale);
    const auto& a = model->focal_density().converging;
    const auto& b = scaled->focal_density().converging;
    REQUIRE(a.nodes().size() == b.nodes().size());
    for (std::size_t i = 0; i < a.nodes().size(); ++i) {
      for (unsigned c = 0; c < 8; ++c) {
        REQUIRE(a.nodes()[i].is_leaf(c) == b.nodes()[i].is_leaf(c));
        if (!a.nodes()[i].is_leaf(c)) continue;
        CHECK(
            a.nodes()[i].density(c) ==
            doctest::Approx(double{b.nodes()[i].density(c)} * scale * scale * scale).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("focal learner: what is absorbed in pieces or merged is what is absorbed at once") {
  const FocalLearner learner(FocalSettings{});
  const auto whole = learner.begin(context()), half = learner.begin(context()),
             other = learner.begin(context());
  whole->absorb(hole_paths(100, 1));
  whole->absorb(hole_paths(100, 2));
  half->absorb(hole_paths(100, 1));
  other->absorb(hole_paths(100, 2));
  half->merge(*other);
  CHECK(saved(*whole) == saved(*half));
  CHECK(saved(*whole->update(0, false)) == saved(*half->update(0, false)));
}

TEST_CASE("focal learner: what another iteration absorbed is not merged") {
  const FocalLearner learner(FocalSettings{});
  const auto state = learner.begin(context()), later = learner.begin(context());
  later->absorb(hole_paths(1000, 1));
  later->update(0, false);
  CHECK_THROWS_AS(state->merge(*later), InputError);
}

TEST_CASE("focal learner: learning starts from 16 x 16 x 16 cells of each sign") {
  // Each octree has 585 nodes of 8 children. Each child has an index or density, a mass and a sum.
  const std::size_t numbers = 2 * 585 * 8 * (sizeof(float) + 2 * sizeof(double));
  const std::size_t size = saved(*FocalLearner(FocalSettings{}).begin(context())).size();
  CHECK(size > numbers);
  CHECK(size < numbers + 1000);
}

TEST_CASE("focal learner: decay keeps a share of what earlier iterations found") {
  const auto mass_of_first = [](float decay) {
    const auto state = FocalLearner({.narrowing_iterations = 0, .decay = decay}).begin(context());
    state->absorb(hole_paths(1000, 1));
    state->update(0, false);
    state->absorb(hole_paths(1000, 2, 1, {-1, 2, 6}));  // the light moves to another place
    const auto model = state->update(1, false);
    return model->density(kCenter) / (model->density(kCenter) + model->density({-1, 2, 6}));
  };
  const double forgotten = mass_of_first(0), kept = mass_of_first(0.5f);
  MESSAGE("density at the old place over both: " << forgotten << ", with decay 0.5 " << kept);
  CHECK(forgotten < 0.05);
  CHECK(kept > 0.2);
}

TEST_CASE("focal learner: narrowing has a decay of its own") {
  // The last of three iterations narrows.
  const auto after = [](float decay, float narrowing_decay) {
    const auto state =
        FocalLearner({.decay = decay, .narrowing_decay = narrowing_decay}).begin(context(1, 3));
    for (std::uint32_t i = 0; i < 2; ++i) {
      state->absorb(hole_paths(500, 1 + i));
      state->update(i, false);
    }
    state->absorb(hole_paths(500, 3));
    return saved(*state->update(2, false));
  };
  CHECK(after(0, 0) != after(0, 0.25f));
}

TEST_CASE("focal learner: a region that is given, and cells no finer than asked for") {
  FocalSettings settings{.region = RegionSettings{{-1, 0.5f, 3}, {1, 2, 5}}, .max_depth = 3};
  const auto model = trained(settings);
  CHECK(model->bounds().low == Point3{-1, 0.5f, 3});
  CHECK(model->bounds().high == Point3{1, 2, 5});
  CHECK(model->focal_density().converging.depth() <= 4);
  settings.region->high.y = 0.5f;
  CHECK_THROWS_AS(FocalLearner{settings}, InputError);
}

TEST_CASE("focal learner: the behavior of the authors' code learns too") {
  const auto model = trained({.splat_extent = SplatExtent::roughness_gated,
                              .splat_weight = SplatWeight::share,
                              .decay = 0.5f,
                              .narrowing_decay = 0.25f});
  CHECK(hits(*model) > 0.3);
}

TEST_CASE("focal learner: saved learning goes on where it stopped") {
  const FocalLearner learner(FocalSettings{});
  const auto state = learner.begin(context());
  state->absorb(hole_paths(1000, 1));
  state->update(0, false);
  state->absorb(hole_paths(1000, 2));
  const auto resumed = learner.begin(context());
  std::istringstream in(saved(*state));
  resumed->load(in);
  CHECK(saved(*resumed) == saved(*state));
  for (std::uint32_t i = 1; i < 4; ++i) {
    state->absorb(hole_paths(500, 10 + i));
    resumed->absorb(hole_paths(500, 10 + i));
    CHECK(saved(*state->update(i, false)) == saved(*resumed->update(i, false)));
  }
}

TEST_CASE("focal learner: nothing is known before light is found, and nothing is forgotten after") {
  const auto state = FocalLearner(FocalSettings{}).begin(context());
  CHECK(state->initial_model() == nullptr);
  CHECK(state->update(0, false) == nullptr);
  state->absorb(hole_paths(1000, 1));
  const auto model = state->update(1, false);
  REQUIRE(model != nullptr);
  CHECK(saved(*state->update(2, false)) == saved(*model));
}

TEST_CASE("focal learner: what no guide has sampled yet is not narrowed") {
  const auto state = FocalLearner({.narrowing_iterations = 5}).begin(context(1, 2));
  state->absorb(hole_paths(1000, 1, 1, kCenter, 1));
  CHECK(state->update(0, false) != nullptr);
}

TEST_CASE("focal learner: pruning makes the model smaller and leaves its mass") {
  const auto pruned = trained({.prune_ratio = 2}), full = trained({.prune_ratio = 0});
  CHECK(pruned->size_bytes() < full->size_bytes());
  const FocalDensity& density = pruned->focal_density();
  CHECK(density.converging.mass() + density.diverging.mass() == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("focal model: cut or damaged files are refused") {
  const std::string bytes = saved(*trained({}));
  const FocalLearner learner(FocalSettings{});
  const auto load = [&](const std::string& text) {
    std::istringstream in(text);
    return learner.load_model(in);
  };
  CHECK(saved(*load(bytes)) == bytes);
  for (const std::size_t size : {std::size_t{0}, std::size_t{4}, std::size_t{20}, std::size_t{60},
                                 bytes.size() / 2, bytes.size() - 1}) {
    CHECK_THROWS_AS(load(bytes.substr(0, size)), InputError);
  }
  CHECK_THROWS_AS(load("x" + bytes), InputError);
  RandomStream random(1);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = bytes;
    damaged[static_cast<std::size_t>(random.next_1d() * static_cast<float>(bytes.size()))] ^=
        static_cast<char>(1 << (i % 8));
    try {
      const auto model = load(damaged);
      // The change of a density was so small that the result is still a density.
      const FocalDensity& density = dynamic_cast<const FocalModel&>(*model).focal_density();
      CHECK(density.converging.mass() + density.diverging.mass() ==
            doctest::Approx(1).epsilon(1e-3));
    } catch (const InputError&) {
    }
  }
}

}  // namespace pharos::focal
