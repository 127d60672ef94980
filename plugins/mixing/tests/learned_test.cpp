#include "../learned.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "three_directions.h"

namespace pharos {
namespace {

using namespace testing;
using Settings = LearnedMixing::Settings;

std::unique_ptr<MixingState> begin(const Settings& settings = {}) {
  return LearnedMixing(settings).begin(std::array{1.0f});
}

/// Returns the share of unguided samples in a region of the only method.
float unguided_share(const MixingState& state, std::uint32_t region = 0) {
  const GuidingQuery vertex{};
  const std::array places{Place{.region = region}};
  std::array<float, 2> shares{};
  CHECK(state.shares()->at({vertex, places}, shares) == region);
  CHECK(shares[0] + shares[1] == doctest::Approx(1));
  return shares[0];
}

/// Returns the share of one region after iterations of `count` paths each.
double learned_share(const Settings& settings, const World& world, int count = 40'000,
                     int iterations = 4, double scale = 1) {
  const auto state = begin(settings);
  state->update(1, {}, false);
  for (int i = 0; i < iterations; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    state->absorb(paths(world, unguided_share(*state), count, seed, 0, scale));
    state->update(1, std::array{0u}, false);
  }
  return unguided_share(*state);
}

Settings free_to_move(MixingObjective which) {
  return {.objective = which, .least = 0.01, .regularization = 0};
}

}  // namespace

TEST_CASE("learned mixing: the optimum in closed form where the samplers find different things") {
  // Divergence: the optimal share of each sampler is the share of what only this sampler finds.
  CHECK(learned_share(free_to_move(MixingObjective::kl), kApart) ==
        doctest::Approx(0.3).epsilon(0.03));
  // Variance: the optimal shares are proportional to the roots of the second moments, 0.3^2 / 0.5
  // and 0.7^2 / 1.
  const double odds = std::sqrt(0.18 / 0.49);
  CHECK(learned_share(free_to_move(MixingObjective::variance), kApart) ==
        doctest::Approx(odds / (1 + odds)).epsilon(0.03));
}

TEST_CASE("learned mixing: the optimum where the samplers overlap") {
  const double kl = best_share(kOverlapping, MixingObjective::kl);
  const double variance = best_share(kOverlapping, MixingObjective::variance);
  REQUIRE(std::abs(kl - variance) > 0.2);  // otherwise the objectives could not be told apart
  CHECK(learned_share(free_to_move(MixingObjective::kl), kOverlapping) ==
        doctest::Approx(kl).epsilon(0.04));
  CHECK(learned_share(free_to_move(MixingObjective::variance), kOverlapping) ==
        doctest::Approx(variance).epsilon(0.04));
}

TEST_CASE("learned mixing: finds the mixture that is what is sought") {
  World world{{0.6, 0.3, 0.1}, {0.1, 0.2, 0.7}, {}};
  for (std::size_t i = 0; i < 3; ++i) world.sought[i] = 5 * world.mixed(i, 0.2);
  for (const auto which : {MixingObjective::kl, MixingObjective::variance}) {
    CHECK(learned_share(free_to_move(which), world) == doctest::Approx(0.2).epsilon(0.05));
  }
}

TEST_CASE("learned mixing: a guide that is the unguided sampler leaves the share where it was") {
  World world = kOverlapping;
  world.guided = world.unguided;
  for (const auto which : {MixingObjective::kl, MixingObjective::variance}) {
    const Settings settings{.objective = which, .initial = 0.3};
    CHECK(learned_share(settings, world) == doctest::Approx(0.3).epsilon(0.01));
  }
}

TEST_CASE("learned mixing: the unit of radiance changes nothing") {
  for (const auto which : {MixingObjective::kl, MixingObjective::variance}) {
    const Settings settings{.objective = which, .regularization = 0.2};
    const double share = learned_share(settings, kApart, 5000, 3);
    CHECK(learned_share(settings, kApart, 5000, 3, 1e4) == doctest::Approx(share).epsilon(1e-4));
  }
}

TEST_CASE("learned mixing: regularization pulls towards the initial share") {
  const double free = learned_share({.initial = 0.6, .regularization = 0}, kApart, 5000);
  const double held = learned_share({.initial = 0.6, .regularization = 0.1}, kApart, 5000);
  const double bound = learned_share({.initial = 0.6, .regularization = 100}, kApart, 5000);
  CHECK(held > free + 0.05);
  CHECK(held < 0.55);
  CHECK(bound == doctest::Approx(0.6).epsilon(0.02));
}

TEST_CASE("learned mixing: both ways keep their least share") {
  const Settings settings{.least = 0.2};
  CHECK(learned_share(settings, kGuideMisses, 2000) == doctest::Approx(0.8));
  CHECK(learned_share(settings, kOnlyGuideFinds, 2000) == doctest::Approx(0.2));
}

TEST_CASE("learned mixing: a region that was long at a limit leaves it at once") {
  const auto state = begin({.least = 0.4, .regularization = 0});
  state->update(1, {}, false);
  for (int i = 0; i < 10; ++i) {
    state->absorb(paths(kGuideMisses, unguided_share(*state), 1000, 1));
    state->update(1, {}, false);
  }
  CHECK(unguided_share(*state) == doctest::Approx(0.6));
  state->absorb(paths(kOnlyGuideFinds, 0.6f, 100, 1));
  state->update(1, {}, false);
  CHECK(unguided_share(*state) < 0.55f);
}

TEST_CASE("learned mixing: the momentum of one iteration is felt in the next") {
  const auto state = begin({.batch = 100, .steps = 1});
  state->update(1, {}, false);
  state->absorb(paths(kGuideMisses, 0.5f, 100, 1));
  state->update(1, {}, false);
  const float there = unguided_share(*state);
  CHECK(there == doctest::Approx(0.5025).epsilon(1e-4));  // one step of 0.01 in log-odds
  // The slope is now reversed and about as steep. Without memory of it, the first step would be
  // undone.
  state->absorb(paths(kOnlyGuideFinds, there, 100, 1));
  state->update(1, {}, false);
  CHECK(unguided_share(*state) > 0.502f);
}

TEST_CASE("learned mixing: few samples move little, none and black ones nothing") {
  const double after_ten = learned_share({}, kOnlyGuideFinds, 10, 1);
  CHECK(after_ten < 0.5);
  CHECK(after_ten > 0.485);  // five steps of 0.01 in log-odds
  CHECK(learned_share({}, kApart, 0, 3) == 0.5);
  const World black{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  CHECK(learned_share({}, black, 1000, 3) == 0.5);
}

TEST_CASE("learned mixing: only finite finds of guided vertices count") {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  PathLog log;
  for (int i = 0; i < 100; ++i) {
    add_path(log, kNoMixing, std::array{Technique{1, 1}}, 1);
    add_path(log, 0, std::array{Technique{0.5f, 1}, Technique{0.5f, 2}}, kInfinite);
    add_path(log, 0, std::array{Technique{0.5f, kInfinite}, Technique{0.5f, 0}}, 1);
    // A zero sample without density.
    add_path(log, 0, std::array{Technique{0.5f, 0}, Technique{0.5f, 0}}, 0);
  }
  const auto state = begin();
  state->update(1, {}, false);
  state->absorb(log);
  state->update(1, {}, false);
  CHECK(unguided_share(*state) == 0.5f);
}

TEST_CASE("learned mixing: refined regions go on from where their origin was") {
  const auto whole = begin(), refined = begin();
  for (const auto* state : {&whole, &refined}) {
    (*state)->update(2, {}, false);
    (*state)->absorb(paths(kApart, 0.5f, 300, 1, 1));
  }
  whole->update(2, std::array{0u, 1u}, false);
  refined->update(4, std::array{1u, 0u, 1u, 0u}, false);
  CHECK(unguided_share(*whole, 0) == 0.5f);
  const float learned = unguided_share(*whole, 1);
  CHECK(learned < 0.45f);
  for (const std::uint32_t region : {0u, 2u}) CHECK(unguided_share(*refined, region) == learned);
  for (const std::uint32_t region : {1u, 3u}) CHECK(unguided_share(*refined, region) == 0.5f);

  // With the same paths, a refined region and its origin take the same steps.
  whole->absorb(paths(kApart, learned, 300, 2, 1));
  refined->absorb(paths(kApart, learned, 300, 2, 2));
  whole->update(2, std::array{0u, 1u}, false);
  refined->update(4, std::array{0u, 1u, 2u, 3u}, false);
  const float next = unguided_share(*whole, 1);
  CHECK(next < learned);
  CHECK(unguided_share(*refined, 2) == next);
  CHECK(unguided_share(*refined, 0) == learned);
}

TEST_CASE("learned mixing: shares that are in use stay as they are") {
  const auto state = begin();
  state->update(1, {}, false);
  const std::shared_ptr<const MixingShares> used = state->shares();
  state->absorb(paths(kOnlyGuideFinds, 0.5f, 300, 1));
  state->update(1, {}, false);
  CHECK(unguided_share(*state) < 0.45f);
  const GuidingQuery vertex{};
  std::array<float, 2> shares{};
  used->at({vertex, std::array{Place{}}}, shares);
  CHECK(shares[0] == 0.5f);
}

TEST_CASE("learned mixing: several guides learn the share that one guide in their place learns") {
  const auto one = begin(), several = begin();
  for (const auto& [state, guides] : {std::pair{&one, 1}, std::pair{&several, 4}}) {
    (*state)->update(1, {}, false);
    (*state)->absorb(paths(kOverlapping, 0.5f, 300, 1, 0, 1, static_cast<std::size_t>(guides)));
    (*state)->update(1, {}, false);
  }
  CHECK(unguided_share(*one) != 0.5f);
  CHECK(unguided_share(*several) == unguided_share(*one));
}

TEST_CASE("learned mixing: the first method that knows something says which region decides") {
  const auto state = LearnedMixing(Settings{}).begin(std::array{1.0f, 3.0f});
  state->update(2, {}, false);
  state->absorb(paths(kApart, 0.5f, 300, 1, 1));
  state->update(2, {}, false);
  const auto shares = state->shares();
  const GuidingQuery vertex{};
  const auto check = [&](float first, float second, std::uint32_t region) {
    const std::array places{Place{.region = 0, .evidence = first},
                            Place{.region = 1, .evidence = second}};
    std::array<float, 3> found{};
    CHECK(shares->at({vertex, places}, found) == region);
    CHECK(found[1] == doctest::Approx(first > 0 ? (1 - found[0]) / (second > 0 ? 4 : 1) : 0));
    CHECK(found[0] + found[1] + found[2] == doctest::Approx(1));
    return found[0];
  };
  CHECK(check(1, 1, 0) == 0.5f);
  CHECK(check(1, 0, 0) == 0.5f);
  CHECK(check(0, 1, 1) < 0.45f);
}

TEST_CASE("learned mixing: a saved state goes on to the bit, in the middle of an iteration") {
  const auto state = begin(), restored = begin();
  state->update(2, {}, false);
  state->absorb(paths(kApart, 0.5f, 300, 1, 1));
  state->update(2, {}, false);
  const float share = unguided_share(*state, 1);
  state->absorb(paths(kApart, share, 300, 2, 1));
  std::stringstream file;
  save(file, *state);
  load(file, *restored);
  CHECK(unguided_share(*restored, 1) == share);
  for (auto* s : {&state, &restored}) {
    (*s)->absorb(paths(kApart, share, 300, 3, 1));
    (*s)->update(2, {}, false);
  }
  CHECK(unguided_share(*state, 1) != share);
  for (const std::uint32_t region : {0u, 1u}) {
    CHECK(unguided_share(*restored, region) == unguided_share(*state, region));
  }
}

TEST_CASE("learned mixing: what was saved otherwise is refused") {
  const auto saved = [] {
    const auto state = begin();
    state->update(2, {}, false);
    std::ostringstream file;
    save(file, *state);
    return file.str();
  }();
  const auto load_into = [](const Settings& settings, const std::string& text) {
    std::istringstream file(text);
    load(file, *begin(settings));
  };
  CHECK_NOTHROW(load_into({}, saved));
  CHECK_THROWS_AS(load_into({.bins = 16}, saved), InputError);
  CHECK_THROWS_AS(load_into({}, saved.substr(0, saved.size() - 1)), InputError);
  CHECK_THROWS_AS(load_into({}, "pharos other 1\n" + saved), InputError);

  const auto with = [&](std::size_t at, double value) {
    std::string damaged = saved;
    std::memcpy(damaged.data() + at, &value, sizeof value);
    return damaged;
  };
  const std::size_t theta = saved.find('\n') + 1 + sizeof(std::uint64_t);
  CHECK_NOTHROW(load_into({}, with(theta, 50)));  // beyond this policy's least share
  CHECK_THROWS_AS(load_into({}, with(theta, 1e300)), InputError);
  CHECK_THROWS_AS(load_into({}, with(theta, std::nan(""))), InputError);
  CHECK_THROWS_AS(load_into({}, with(theta + 16, -1)), InputError);       // the mean square
  CHECK_THROWS_AS(load_into({}, with(theta + 24, 2)), InputError);        // weight of the start
  CHECK_THROWS_AS(load_into({}, with(saved.size() - 8, 1)), InputError);  // a bin's moment alone
}

TEST_CASE("learned mixing: an initial share beyond the least is refused") {
  CHECK_THROWS_AS(LearnedMixing({.initial = 0.1, .least = 0.2}), InputError);
  CHECK_THROWS_AS(LearnedMixing({.initial = 0.9, .least = 0.2}), InputError);
  CHECK_NOTHROW(LearnedMixing({.initial = 0.2, .least = 0.2}));
}

}  // namespace pharos
