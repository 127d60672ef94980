#include "../learner.h"

#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

#include "../model.h"
#include "hole_paths.h"

namespace pharos::focal {
namespace {

using namespace testing;
using test::saved;

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
  CHECK(!fixed->info().bounds.contains(kImage));
  CHECK(grown->info().bounds.contains(kImage));
  CHECK(after > 0.3);
  CHECK(after > 5 * before);
  // Focal points within the scene let the region grow at most once.
  const auto inside = trained({.region_growths = 3});
  CHECK(inside->info().bounds.diagonal() <= 2.001f * fixed->info().bounds.diagonal());
}

TEST_CASE("focal learner: each part of space learns which focal points it sees") {
  // A wall parts the scene at x = 0, with a hole in each half.
  constexpr Point3 kHoles[] = {{-0.7f, 1.1f, 3.9f}, {0.8f, 0.9f, 4.1f}};
  const auto trained_behind_wall = [&](int local_cells) {
    const auto state = FocalLearner({.burn_in = 1, .local_cells = local_cells}).begin(context());
    Learned learned;
    for (std::uint32_t i = 0; i < 6; ++i) {
      PathLog log;
      for (const Point3 hole : kHoles) add_hole_paths(log, 3000, 7 + i, 1, hole, 0.5f, 1, hole.x);
      state->absorb(log);
      learned = state->update({i, 5 - i});
    }
    return std::dynamic_pointer_cast<const FocalModel>(learned.model);
  };
  const auto everywhere = trained_behind_wall(1), local = trained_behind_wall(2);
  // The share of a hole in the density of the whole scene, if its part of space has no other.
  double shares = 0;
  for (const Point3 from : {Point3{-1, 1, 2}, Point3{0.5f, 1.5f, 2}}) {
    for (const Point3 hole : kHoles) {
      const Vec3 direction = normalize(hole - from);
      const double gain = local->density(from, &direction) / everywhere->density(from, &direction);
      if (from.x * hole.x > 0) {
        CHECK(gain > 1.1);
        shares += 1 / gain;
      } else {
        CHECK(gain < 0.1);
      }
    }
  }
  CHECK(shares == doctest::Approx(1).epsilon(0.1));
}

TEST_CASE("focal learner: the same model for any number of threads") {
  for (const auto& [catch_up, local_cells] : {std::pair{0, 1}, {8, 1}, {0, 3}}) {
    std::string first;
    for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const auto state =
          FocalLearner({.burn_in = 1, .catch_up = catch_up, .local_cells = local_cells})
              .begin(context());
      state->absorb(hole_paths(catch_up > 0 ? 20 : 150'000, 1));
      state->update({0, 1});
      state->absorb(hole_paths(150'000, 2));
      state->update({1, 1});
      state->absorb(hole_paths(1000, 3));
      const std::string bits = saved(*state->update({2, 0}).model);
      if (first.empty()) first = bits;
      CHECK(bits == first);
    }
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

TEST_CASE("focal learner: what is absorbed in pieces is what is absorbed at once") {
  const FocalLearner learner(FocalSettings{});
  const auto whole = learner.begin(context()), pieces = learner.begin(context());
  PathLog log = hole_paths(100, 1);
  add_hole_paths(log, 100, 2);
  whole->absorb(log);
  pieces->absorb(hole_paths(100, 1));
  pieces->absorb(hole_paths(100, 2));
  CHECK(saved(*whole) == saved(*pieces));
  CHECK(saved(*whole->update({0, 1}).model) == saved(*pieces->update({0, 1}).model));
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
    state->update({0, 1});
    state->absorb(hole_paths(1000, 2, 1, {-1, 2, 6}));  // light moves to another place
    const auto model = state->update({1, 1}).model;
    return model->density(kCenter) / (model->density(kCenter) + model->density({-1, 2, 6}));
  };
  const double forgotten = mass_of_first(0), kept = mass_of_first(0.5f);
  MESSAGE("density at the old place over both: " << forgotten << ", with decay 0.5 " << kept);
  CHECK(forgotten < 0.05);
  CHECK(kept > 0.2);
}

TEST_CASE("focal learner: narrowing after a burn-in, whenever training ends") {
  const double last = hits(*trained({.narrowing_iterations = 5}));
  const double early = hits(*trained({.narrowing_iterations = 0, .burn_in = 1}));
  MESSAGE("share of directions through the hole: " << last << ", narrowed early " << early);
  CHECK(early > 0.8 * last);
  // A burn-in longer than training narrows nothing.
  const double never = hits(*trained({.burn_in = 1000}));
  CHECK(never == doctest::Approx(hits(*trained({.narrowing_iterations = 0}))));
}

TEST_CASE("focal learner: narrowing has a decay of its own") {
  // The last of three iterations narrows.
  const auto after = [](float decay, float narrowing_decay) {
    const auto state =
        FocalLearner({.decay = decay, .narrowing_decay = narrowing_decay}).begin(context());
    for (std::uint32_t i = 0; i < 2; ++i) {
      state->absorb(hole_paths(500, 1 + i));
      state->update({i, 2 - i});
    }
    state->absorb(hole_paths(500, 3));
    return saved(*state->update({2, 0}).model);
  };
  CHECK(after(0, 0) != after(0, 0.25f));
}

TEST_CASE("focal learner: a region that is given, and cells no finer than asked for") {
  FocalSettings settings{.region = RegionSettings{{-1, 0.5f, 3}, {1, 2, 5}}, .max_depth = 3};
  const auto model = trained(settings);
  CHECK(model->info().bounds.low == Point3{-1, 0.5f, 3});
  CHECK(model->info().bounds.high == Point3{1, 2, 5});
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
  for (const auto& [catch_up, local_cells] : {std::pair{0, 1}, {8, 1}, {0, 2}}) {
    // More segments than fit into a batch, and more than are kept.
    const FocalLearner learner(
        {.burn_in = 1, .catch_up = catch_up, .kept_segments = 1000, .local_cells = local_cells});
    const auto state = learner.begin(context());
    state->absorb(hole_paths(20, 1));
    state->update({0, 1});
    state->absorb(hole_paths(70'000, 2));
    const auto resumed = learner.begin(context());
    std::istringstream in(saved(*state));
    load(in, *resumed);
    CHECK(saved(*resumed) == saved(*state));
    for (std::uint32_t i = 1; i < 4; ++i) {
      state->absorb(hole_paths(500, 10 + i));
      resumed->absorb(hole_paths(500, 10 + i));
      CHECK(saved(*state->update({i, 1}).model) == saved(*resumed->update({i, 1}).model));
    }
  }
}

TEST_CASE("focal learner: nothing is known before light is found, and nothing is forgotten after") {
  const auto state = FocalLearner(FocalSettings{}).begin(context());
  CHECK(state->update({0, 1}).model == nullptr);
  state->absorb(hole_paths(1000, 1));
  const auto model = state->update({1, 1}).model;
  REQUIRE(model != nullptr);
  CHECK(saved(*state->update({2, 1}).model) == saved(*model));
}

TEST_CASE("focal learner: what no guide has sampled yet is not narrowed") {
  const auto state = FocalLearner({.narrowing_iterations = 5}).begin(context());
  state->absorb(hole_paths(1000, 1, 1, kCenter, 1));
  CHECK(state->update({0, 1}).model != nullptr);
}

TEST_CASE("focal learner: pruning makes the model smaller and leaves its mass") {
  const auto pruned = trained({.prune_ratio = 2}), full = trained({.prune_ratio = 0});
  CHECK(pruned->info().bytes < full->info().bytes);
  const FocalDensity& density = pruned->focal_density();
  CHECK(density.converging.mass() + density.diverging.mass() == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("focal model: cut or damaged files are refused") {
  const std::string bytes = saved(*trained({}));
  const FocalLearner learner(FocalSettings{});
  const auto loaded = [&](const std::string& text) {
    std::istringstream in(text);
    const auto model = learner.empty_model();
    load(in, *model);
    return model;
  };
  CHECK(saved(*loaded(bytes)) == bytes);
  for (const std::size_t size : {std::size_t{0}, std::size_t{4}, std::size_t{20}, std::size_t{60},
                                 bytes.size() / 2, bytes.size() - 1}) {
    CHECK_THROWS_AS(loaded(bytes.substr(0, size)), InputError);
  }
  CHECK_THROWS_AS(loaded("x" + bytes), InputError);
  RandomStream random(1);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = bytes;
    damaged[static_cast<std::size_t>(random.next_1d() * static_cast<float>(bytes.size()))] ^=
        static_cast<char>(1 << (i % 8));
    try {
      const auto model = loaded(damaged);
      // A density was changed, so little that it is one still.
      const FocalDensity& density = dynamic_cast<const FocalModel&>(*model).focal_density();
      CHECK(density.converging.mass() + density.diverging.mass() ==
            doctest::Approx(1).epsilon(1e-3));
    } catch (const InputError&) {
    }
  }
}

}  // namespace pharos::focal
