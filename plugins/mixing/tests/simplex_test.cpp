#include "../simplex.h"

#include <array>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>

#include "three_directions.h"

namespace pharos {
namespace {

using namespace testing;
using Settings = SimplexMixing::Settings;

/// Settings without prior, bounds and exploration.
Settings free_to_move(MixingObjective objective = MixingObjective::variance) {
  return {.objective = objective,
          .unguided = 0.5,
          .least = 1e-4,
          .explore = 0,
          .worth = 1,
          .prior_steps = 1e-6};
}

std::unique_ptr<MixingState> begun(const Settings& settings, std::span<const float> weights) {
  auto state = SimplexMixing(settings).begin(weights);
  state->update(1, {}, false);
  return state;
}
std::unique_ptr<MixingState> begun(const Settings& settings = {}) {
  return begun(settings, std::array{1.0f});
}

/// The shares at a vertex, and their key.
struct Answer {
  std::array<float, 2> shares{};
  std::uint32_t key = 0;
};

Answer ask(const MixingState& state, const GuidingQuery& vertex = {}, float evidence = 1e9f) {
  Answer answer;
  answer.key = state.shares()->at({vertex, std::array{Place{.evidence = evidence}}}, answer.shares);
  CHECK(answer.shares[0] > 0);
  CHECK(answer.shares[0] + answer.shares[1] == doctest::Approx(1));
  return answer;
}

GuidingQuery vertex_at(Point3 position, float roughness = 1, std::uint16_t bounce = 1) {
  GuidingQuery query;
  query.current.position = position;
  query.current.roughness = roughness;
  query.bounce = bounce;
  return query;
}

/// Renders `count` paths that begin at a vertex.
void absorb(MixingState& state, const World& world, int count, std::uint64_t seed,
            const GuidingQuery& vertex = {}) {
  const Answer now = ask(state, vertex);
  state.absorb(paths(world, now.shares[0], count, seed, now.key, 1, 1, vertex.current.position));
}

/// Returns the unguided share after iterations of `count` paths each.
double learned_share(const Settings& settings, const World& world, int count = 20'000,
                     int iterations = 3) {
  const auto state = begun(settings);
  for (int i = 0; i < iterations; ++i) {
    absorb(*state, world, count, static_cast<std::uint64_t>(i));
    state->update(1, {}, i + 1 == iterations);
  }
  return ask(*state).shares[0];
}

}  // namespace

TEST_CASE("simplex mixing: the optimum in closed form where the samplers find different things") {
  const double odds = std::sqrt(0.18 / 0.49);  // of the roots of the second moments
  CHECK(learned_share(free_to_move(), kApart) == doctest::Approx(odds / (1 + odds)).epsilon(0.03));
  // Divergence: the optimal share of each sampler is the share of what only this sampler finds.
  CHECK(learned_share(free_to_move(MixingObjective::kl), kApart) ==
        doctest::Approx(0.3).epsilon(0.03));
}

TEST_CASE("simplex mixing: the optimum where the samplers overlap") {
  for (const auto objective : {MixingObjective::variance, MixingObjective::kl}) {
    CHECK(learned_share(free_to_move(objective), kOverlapping) ==
          doctest::Approx(best_share(kOverlapping, objective)).epsilon(0.04));
  }
}

TEST_CASE(
    "simplex mixing: unguided sampling keeps its least share, and methods theirs in training") {
  Settings settings = free_to_move();
  settings.least = 0.2;
  settings.explore = 0.1;
  settings.unguided = 0.6;
  CHECK(learned_share(settings, kOnlyGuideFinds) == doctest::Approx(0.2).epsilon(1e-3));
  const auto state = begun(settings);
  absorb(*state, kGuideMisses, 2000, 1);
  state->update(1, {}, false);
  CHECK(ask(*state).shares[1] == doctest::Approx(0.1 / 1.1).epsilon(1e-3));
  absorb(*state, kGuideMisses, 2000, 2);
  state->update(1, {}, true);
  CHECK(ask(*state).shares[1] == 0);
}

TEST_CASE("simplex mixing: in the end, a guide is asked only where it is worth its cost") {
  Settings settings = free_to_move();
  const double gain = objective(kOverlapping, 1, MixingObjective::variance) /
                      objective(kOverlapping, best_share(kOverlapping, MixingObjective::variance),
                                MixingObjective::variance);
  REQUIRE(gain > 1.1);
  settings.worth = 0.9 * gain;
  CHECK(learned_share(settings, kOverlapping) < 1);
  settings.worth = 1.1 * gain;
  CHECK(learned_share(settings, kOverlapping) == 1);
}

TEST_CASE("simplex mixing: a guide earns its share step by step") {
  CHECK(ask(*begun()).shares[0] == doctest::Approx(0.75));
  const Settings settings{.prior_steps = 32};
  const double few = learned_share(settings, kOnlyGuideFinds, 16, 1);
  CHECK(few > 0.4);
  CHECK(few < 0.7);
  CHECK(learned_share({}, kOnlyGuideFinds, 16, 1) < few);  // its prior counts less
  CHECK(learned_share({}, kOnlyGuideFinds, 5000, 1) < 0.12);
  CHECK(learned_share({}, kOnlyGuideFinds, 0, 3) == 1);
}

TEST_CASE("simplex mixing: a single bright step counts as one step") {
  const auto state = begun({.prior_steps = 8});
  const Answer before = ask(*state);
  absorb(*state, kGuideMisses, 1000, 1);
  PathLog log;
  const std::array techniques{Technique{0.75f, 1e-3f}, Technique{0.25f, 1}};
  add_path(log, before.key, techniques, 1e5);
  state->absorb(log);
  state->update(1, {}, false);
  // The guide alone finds the step, so the best share of unguided samples is the least one, 0.1. A
  // ninth of the way leads there from 0.75 for the whole scene, and another ninth for the cell.
  const double scene = (0.1 + 8 * 0.75) / 9;
  CHECK(ask(*state).shares[0] == doctest::Approx((0.1 + 8 * scene) / 9).epsilon(1e-3));
}

TEST_CASE("simplex mixing: a single step that a guide cannot draw does not drop the guide") {
  // Only the guide finds light, `here` in many steps and `there` in none or in few.
  constexpr World kDark{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const auto here = vertex_at({0, 0, 0}), there = vertex_at({100, 0, 0});
  for (const bool has_history : {false, true}) {
    CAPTURE(has_history);
    const auto state = begun({.cell_steps = 64});
    absorb(*state, kOnlyGuideFinds, 2000, 1, here);
    absorb(*state, kDark, 2000, 2, there);
    state->update(1, {}, false);
    absorb(*state, kOnlyGuideFinds, 2000, 3, here);
    if (has_history) absorb(*state, kOnlyGuideFinds, 60, 4, there);
    state->update(1, {}, false);
    const auto find_by_chance = [&](int steps) {
      PathLog log;
      const Answer now = ask(*state, there);
      const std::array techniques{Technique{now.shares[0], 1}, Technique{now.shares[1], 0}};
      for (int i = 0; i < steps; ++i) {
        add_path(log, now.key, techniques, 1, there.current.position);
      }
      state->absorb(log);
      state->update(1, {}, true);
      return ask(*state, there).shares[1];
    };
    CHECK(find_by_chance(1) > 0.5);
    CHECK(find_by_chance(1000) == 0);
  }
}

TEST_CASE("simplex mixing: what a model knows of a place scales the odds of its method") {
  const auto state = begun({.unguided = 0.5, .evidence = 32});
  CHECK(ask(*state, {}, 1e9f).shares[1] == doctest::Approx(0.5));
  CHECK(ask(*state, {}, 32).shares[1] == doctest::Approx(1 / 3.0));
  CHECK(ask(*state, {}, 0).shares[1] == 0);
}

TEST_CASE("simplex mixing: every class of vertices learns its own shares") {
  const std::array vertices{vertex_at({}, 0.01f), vertex_at({}, 0.2f), vertex_at({}, 1),
                            vertex_at({}, 1, 2)};
  // Vertices of paths from both ends have no number and belong to the class of later vertices.
  CHECK(ask(*begun(), vertex_at({}, 1, 0)).key == ask(*begun(), vertex_at({}, 1, 2)).key);
  for (std::size_t taught = 0; taught < vertices.size(); ++taught) {
    CAPTURE(taught);
    const auto state = begun();
    absorb(*state, kOnlyGuideFinds, 2000, 1, vertices[taught]);
    state->update(1, {}, false);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const float share = ask(*state, vertices[i]).shares[0];
      const bool is_right = i == taught ? share < 0.2f : share == 0.75f;
      CHECK(is_right);
    }
  }
}

TEST_CASE("simplex mixing: every place learns its own shares, once it has enough steps") {
  const auto learn = [](std::uint32_t cell_steps) {
    auto state = begun({.cell_steps = cell_steps});
    for (const std::uint64_t seed : {1u, 2u}) {
      absorb(*state, kGuideMisses, 2000, seed, vertex_at({-1, 0, 0}));
      absorb(*state, kOnlyGuideFinds, 2000, seed, vertex_at({1, 0, 0}));
      state->update(1, {}, false);
    }
    return state;
  };
  const auto one = learn(100'000), many = learn(1000);
  CHECK(ask(*one, vertex_at({-1, 0, 0})).shares[0] == ask(*one, vertex_at({1, 0, 0})).shares[0]);
  CHECK(ask(*many, vertex_at({-1, 0, 0})).shares[0] > 0.9f);
  CHECK(ask(*many, vertex_at({1, 0, 0})).shares[0] < 0.2f);
}

TEST_CASE("simplex mixing: of two methods, the one that finds light gets the share") {
  const auto state = begun({}, std::array{1.0f, 3.0f});
  const std::array places{Place{.evidence = 1e9f}, Place{.evidence = 1e9f}};
  std::array<float, 3> shares{};
  const auto ask_both = [&] { return state->shares()->at({GuidingQuery{}, places}, shares); };
  const std::uint32_t key = ask_both();
  CHECK(shares[1] == doctest::Approx(0.25 / 4));
  CHECK(shares[2] == doctest::Approx(0.75 / 4));
  PathLog log;
  for (int i = 0; i < 2000; ++i) {
    const std::array techniques{Technique{shares[0], 0.1f}, Technique{shares[1], 4},
                                Technique{shares[2], 0.05f}};
    add_path(log, key, techniques, 1);
  }
  state->absorb(log);
  state->update(1, {}, true);
  ask_both();
  CHECK(shares[1] > 0.85f);
  CHECK(shares[2] == 0);
}

TEST_CASE("simplex mixing: methods without a share anywhere are not asked in the final image") {
  for (const auto& [world, is_asked] : {std::pair{kOnlyGuideFinds, true}, {kGuideMisses, false}}) {
    const auto state = begun();
    CHECK(state->shares()->asks(0));
    absorb(*state, world, 2000, 1);
    state->update(1, {}, false);
    CHECK(state->shares()->asks(0));  // it may still earn something
    absorb(*state, world, 2000, 2);
    state->update(1, {}, true);
    CHECK(state->shares()->asks(0) == is_asked);
  }
}

TEST_CASE("simplex mixing: where no light was found, the final image is not guided") {
  const auto state = begun();
  absorb(*state, kOnlyGuideFinds, 2000, 1);
  state->update(1, {}, true);
  CHECK(ask(*state).shares[0] < 0.5f);
  GuidingQuery other = vertex_at({});
  other.current.kind = VertexKind::volume;
  CHECK(ask(*state, other).shares[0] == 1);
}

TEST_CASE("simplex mixing: only finite steps of guided vertices count") {
  constexpr float kInfinite = INFINITY;
  const auto state = begun();
  const Answer before = ask(*state);
  PathLog log;
  for (int i = 0; i < 100; ++i) {
    add_path(log, kNoMixing, std::array{Technique{1, 1}}, 1);
    add_path(log, before.key, std::array{Technique{0.5f, 1}, Technique{0.5f, 2}}, kInfinite);
    add_path(log, before.key, std::array{Technique{0.5f, kInfinite}, Technique{0.5f, 0}}, 1);
    add_path(log, before.key, std::array{Technique{0.5f, 0}, Technique{0.5f, 0}}, 0);
  }
  state->absorb(log);
  state->update(1, {}, false);
  CHECK(ask(*state).shares[0] == before.shares[0]);
}

TEST_CASE("simplex mixing: shares that are in use stay as they are") {
  const auto state = begun();
  const std::shared_ptr<const MixingShares> used = state->shares();
  absorb(*state, kOnlyGuideFinds, 2000, 1);
  state->update(1, {}, false);
  std::array<float, 2> shares{};
  used->at({GuidingQuery{}, std::array{Place{.evidence = 1e9f}}}, shares);
  CHECK(shares[0] == 0.75f);
}

TEST_CASE("simplex mixing: the same bits for any number of threads") {
  const auto learned = [] {
    const auto state = begun({.cell_steps = 200, .reservoir = 16});
    for (const std::uint64_t seed : {1u, 2u}) {
      for (const float x : {-3.0f, -1.0f, 0.5f, 2.0f}) {
        absorb(*state, kOverlapping, 500, seed, vertex_at({x, 0, 0}));
      }
      state->update(1, {}, false);
    }
    std::ostringstream file;
    save(file, *state);
    return file.str();
  };
  const std::string expected = learned();
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    CHECK(learned() == expected);
  }
}

TEST_CASE("simplex mixing: a saved state goes on to the bit, in the middle of an iteration") {
  const Settings settings{.cell_steps = 500, .reservoir = 16};
  const auto state = begun(settings), restored = begun(settings);
  const auto here = vertex_at({1, 2, 3}), there = vertex_at({-1, 2, 3});
  for (const auto& vertex : {here, there}) absorb(*state, kApart, 1000, 1, vertex);
  state->update(1, {}, false);
  absorb(*state, kApart, 300, 2, here);
  std::stringstream file;
  save(file, *state);
  load(file, *restored);
  const float before = ask(*state, here).shares[0];
  CHECK(ask(*restored, here).shares[0] == before);
  for (const auto* each : {&state, &restored}) {
    absorb(**each, kApart, 300, 3, here);
    (*each)->update(1, {}, true);
  }
  CHECK(ask(*state, here).shares[0] != before);
  for (const auto& vertex : {here, there}) {
    CHECK(ask(*restored, vertex).shares[0] == ask(*state, vertex).shares[0]);
  }
}

TEST_CASE("simplex mixing: damaged states are refused or sound") {
  const auto state = begun({.cell_steps = 500, .reservoir = 16});
  absorb(*state, kApart, 1000, 1);
  state->update(1, {}, false);
  std::ostringstream file;
  save(file, *state);
  const std::string good = file.str();
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += 7) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    std::istringstream in(bad);
    const auto loaded = begun();
    try {
      load(in, *loaded);
      ask(*loaded);
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 10);
  std::istringstream cut(good.substr(0, good.size() - 1));
  CHECK_THROWS_AS(load(cut, *begun()), InputError);
}

TEST_CASE("simplex mixing: settings that contradict each other are refused") {
  CHECK_THROWS_AS(SimplexMixing({.unguided = 0.1, .least = 0.2}), InputError);
}

TEST_CASE("simplex: a method that is left out has no share any more") {
  const auto shares_of = [](const MixingState& state) {
    std::array<float, 3> shares{};
    const std::array places{Place{.evidence = 1e9f}, Place{.evidence = 1e9f}};
    state.shares()->at({GuidingQuery{}, places}, shares);
    return shares;
  };
  const std::array weights{1.0f, 1.0f};
  const auto state = begun(Settings{}, weights), resumed = begun(Settings{}, weights);
  const std::array<float, 3> before = shares_of(*state);
  const std::uint32_t key = ask(*begun()).key;
  // One of the two guides draws all guided samples and finds all light.
  state->absorb(paths(kOnlyGuideFinds, before[0], 20'000, 1, key));
  state->update(1, {}, false);
  CHECK(shares_of(*state)[1] > 2 * before[1]);  // it has earned more

  state->leave_out(0);
  state->update(1, {}, false);  // without new steps
  std::ostringstream out;
  save(out, *state);
  std::istringstream in(out.str());
  load(in, *resumed);
  for (MixingState* each : {state.get(), resumed.get()}) {
    const std::array<float, 3> shares = shares_of(*each);
    CHECK(shares[1] == 0);
    CHECK(shares[2] > 0);
    CHECK(shares[0] + shares[2] == doctest::Approx(1));
    CHECK_FALSE(each->shares()->asks(0));
    CHECK(each->shares()->asks(1));
    // New steps do not bring it back, neither in training nor in the end.
    for (const bool last : {false, true}) {
      each->absorb(paths(kOnlyGuideFinds, 0.5f, 20'000, 2, key));
      each->update(1, {}, last);
      CHECK_FALSE(each->shares()->asks(0));
    }
  }
}

TEST_CASE("simplex mixing: if learning ends early, no steps wait, and guides explore no more") {
  const auto state = begun();
  const auto size = [&] {
    std::ostringstream out;
    save(out, *state);
    return out.str().size();
  };
  absorb(*state, kGuideMisses, 20'000, 1);
  state->update(1, {}, false);
  const std::size_t before = size();
  CHECK(ask(*state).shares[1] > 0.04f);
  absorb(*state, kGuideMisses, 20'000, 2);
  CHECK(size() > before + 20'000);
  state->end_learning();
  CHECK(size() == before);
  CHECK(ask(*state).shares[1] == 0);
}

}  // namespace pharos
