#include "../learned.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>

namespace pharos {
namespace {

using Settings = LearnedMixing::Settings;

/// All there is: three directions, with the probability that each sampler gives them and what is
/// sought there.
struct World {
  std::array<double, 3> unguided, guided, sought;

  double mixed(std::size_t i, double share) const {
    return share * unguided[i] + (1 - share) * guided[i];
  }
};

/// Where either way finds what the other misses.
constexpr World kApart{{0.5, 0.5, 0}, {0, 0, 1}, {0.3, 0, 0.7}};
/// Where no mixture is perfect.
constexpr World kOverlapping{{0.7, 0.2, 0.1}, {0.3, 0.1, 0.6}, {0.1, 0.5, 0.4}};
constexpr World kGuideMisses{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
constexpr World kOnlyGuideFinds{{1, 0, 0}, {0, 1, 0}, {0, 1, 0}};

std::size_t choose(const std::array<double, 3>& probabilities, double u) {
  std::size_t i = 0;
  while (i < 2 && u >= probabilities[i]) u -= probabilities[i++];
  return i;
}

/// Adds a path with one guided step that found `found` times the radiance 1.
void add_path(PathLog& log, RecordedVertex vertex, double found) {
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .local_weight = Rgb(1)});
  vertex.parent = 0;
  vertex.guidable = true;
  vertex.local_weight = Rgb(static_cast<float>(found));
  log.add(vertex);
  log.add(RecordedVertex{.parent = 1, .emission = Rgb(1)});
}

/// Paths that take one step each, drawn from the mixture of a share. `scale` is the unit of
/// radiance.
PathLog paths(const World& world, float share, int count, std::uint64_t seed,
              std::uint32_t region = 0, double scale = 1) {
  PathLog log;
  RandomStream random(seed);
  for (int k = 0; k < count; ++k) {
    const bool unguided = random.next_1d() < share;
    const std::size_t i = choose(unguided ? world.unguided : world.guided, random.next_1d());
    const RecordedVertex vertex{.unguided_pdf = static_cast<float>(world.unguided[i]),
                                .guided_pdf = static_cast<float>(world.guided[i]),
                                .unguided_fraction = share,
                                .region = region};
    add_path(log, vertex, scale * world.sought[i] / world.mixed(i, share));
  }
  return log;
}

/// One region's share after iterations of `count` paths each.
double learned_share(const Settings& settings, const World& world, int count = 40'000,
                     int iterations = 4, double scale = 1) {
  const auto state = LearnedMixing(settings).begin();
  auto fractions = state->update(1, {});
  for (int i = 0; i < iterations; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    state->absorb(paths(world, fractions->unguided_fraction(0), count, seed, 0, scale));
    fractions = state->update(1, std::array{0u});
  }
  return fractions->unguided_fraction(0);
}

double objective(const World& world, double share, MixingObjective which) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double f = world.sought[i], q = world.mixed(i, share);
    if (f > 0) sum += which == MixingObjective::kl ? -f * std::log(q) : f * f / q;
  }
  return sum;
}

/// The best share, by trying all.
double best_share(const World& world, MixingObjective which) {
  double best = 0.5;
  for (double share = 0.001; share < 1; share += 0.001) {
    if (objective(world, share, which) < objective(world, best, which)) best = share;
  }
  return best;
}

Settings free_to_move(MixingObjective which) {
  return {.objective = which, .least = 0.01, .regularization = 0};
}

}  // namespace

TEST_CASE("learned mixing: the optimum in closed form where the samplers find different things") {
  // Divergence: each sampler gets the share of what only it finds.
  CHECK(learned_share(free_to_move(MixingObjective::kl), kApart) ==
        doctest::Approx(0.3).epsilon(0.03));
  // Variance: shares as the roots of the second moments, 0.3^2 / 0.5 and 0.7^2 / 1.
  const double odds = std::sqrt(0.18 / 0.49);
  CHECK(learned_share(free_to_move(MixingObjective::variance), kApart) ==
        doctest::Approx(odds / (1 + odds)).epsilon(0.03));
}

TEST_CASE("learned mixing: the optimum where the samplers overlap") {
  const double kl = best_share(kOverlapping, MixingObjective::kl);
  const double variance = best_share(kOverlapping, MixingObjective::variance);
  REQUIRE(std::abs(kl - variance) > 0.2);  // or the objectives could not be told apart
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
  const auto state = LearnedMixing({.least = 0.4, .regularization = 0}).begin();
  auto fractions = state->update(1, {});
  for (int i = 0; i < 10; ++i) {
    state->absorb(paths(kGuideMisses, fractions->unguided_fraction(0), 1000, 1));
    fractions = state->update(1, {});
  }
  CHECK(fractions->unguided_fraction(0) == doctest::Approx(0.6));
  state->absorb(paths(kOnlyGuideFinds, 0.6f, 100, 1));
  CHECK(state->update(1, {})->unguided_fraction(0) < 0.55f);
}

TEST_CASE("learned mixing: the momentum of one iteration is felt in the next") {
  const auto state = LearnedMixing({.batch = 100, .steps = 1}).begin();
  state->update(1, {});
  state->absorb(paths(kGuideMisses, 0.5f, 100, 1));
  const float there = state->update(1, {})->unguided_fraction(0);
  CHECK(there == doctest::Approx(0.5025).epsilon(1e-4));  // one step of 0.01 in log-odds
  // The slope is now the opposite, and about as steep: without memory all would be undone.
  state->absorb(paths(kOnlyGuideFinds, there, 100, 1));
  CHECK(state->update(1, {})->unguided_fraction(0) > 0.502f);
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
    add_path(log, {.unguided_pdf = 1, .unguided_fraction = 1}, 1);
    add_path(log, {.unguided_pdf = 1, .guided_pdf = 2, .unguided_fraction = 0.5f}, kInfinite);
    add_path(log, {.unguided_pdf = kInfinite, .unguided_fraction = 0.5f}, 1);
    add_path(log, {.unguided_fraction = 0.5f}, 0);  // a zero sample without density
  }
  const auto state = LearnedMixing(Settings{}).begin();
  state->update(1, {});
  state->absorb(log);
  CHECK(state->update(1, {})->unguided_fraction(0) == 0.5f);
}

TEST_CASE("learned mixing: refined regions go on from where their origin was") {
  const auto whole = LearnedMixing(Settings{}).begin(), refined = LearnedMixing(Settings{}).begin();
  for (const auto* state : {&whole, &refined}) {
    (*state)->update(2, {});
    (*state)->absorb(paths(kApart, 0.5f, 300, 1, 1));
  }
  const auto before = whole->update(2, std::array{0u, 1u});
  const auto after = refined->update(4, std::array{1u, 0u, 1u, 0u});
  CHECK(before->unguided_fraction(0) == 0.5f);
  const float learned = before->unguided_fraction(1);
  CHECK(learned < 0.45f);
  for (const std::uint32_t region : {0u, 2u}) CHECK(after->unguided_fraction(region) == learned);
  for (const std::uint32_t region : {1u, 3u}) CHECK(after->unguided_fraction(region) == 0.5f);

  // With the same paths, heir and origin take the same steps.
  whole->absorb(paths(kApart, learned, 300, 2, 1));
  refined->absorb(paths(kApart, learned, 300, 2, 2));
  const float next = whole->update(2, std::array{0u, 1u})->unguided_fraction(1);
  const auto heirs = refined->update(4, std::array{0u, 1u, 2u, 3u});
  CHECK(next < learned);
  CHECK(heirs->unguided_fraction(2) == next);
  CHECK(heirs->unguided_fraction(0) == learned);
}

TEST_CASE("learned mixing: a saved state goes on to the bit, in the middle of an iteration") {
  const auto state = LearnedMixing(Settings{}).begin(),
             restored = LearnedMixing(Settings{}).begin();
  state->update(2, {});
  state->absorb(paths(kApart, 0.5f, 300, 1, 1));
  const float share = state->update(2, {})->unguided_fraction(1);
  state->absorb(paths(kApart, share, 300, 2, 1));
  std::stringstream file;
  state->save(file);
  restored->load(file);
  for (auto* s : {&state, &restored}) (*s)->absorb(paths(kApart, share, 300, 3, 1));
  const auto expected = state->update(2, {}), found = restored->update(2, {});
  CHECK(expected->unguided_fraction(1) != share);
  for (const std::uint32_t region : {0u, 1u}) {
    CHECK(found->unguided_fraction(region) == expected->unguided_fraction(region));
  }
}

TEST_CASE("learned mixing: what was saved otherwise is refused") {
  const auto saved = [] {
    const auto state = LearnedMixing(Settings{}).begin();
    state->update(2, {});
    std::ostringstream file;
    state->save(file);
    return file.str();
  }();
  const auto load = [](const Settings& settings, const std::string& text) {
    std::istringstream file(text);
    LearnedMixing(settings).begin()->load(file);
  };
  CHECK_NOTHROW(load({}, saved));
  CHECK_THROWS_AS(load({.objective = MixingObjective::variance}, saved), InputError);
  CHECK_THROWS_AS(load({.bins = 16}, saved), InputError);
  CHECK_THROWS_AS(load({}, saved.substr(0, saved.size() - 1)), InputError);
  CHECK_THROWS_AS(load({}, "pharos other 1\n" + saved), InputError);

  const auto with = [&](std::size_t at, double value) {
    std::string damaged = saved;
    std::memcpy(damaged.data() + at, &value, sizeof value);
    return damaged;
  };
  const std::size_t theta = saved.find('\n') + 1 + 2 * sizeof(std::uint32_t) + 8;
  CHECK_NOTHROW(load({}, with(theta, 1e300)));  // beyond this policy's least share
  CHECK_THROWS_AS(load({}, with(theta, std::nan(""))), InputError);
  CHECK_THROWS_AS(load({}, with(theta + 16, -1)), InputError);       // the mean square
  CHECK_THROWS_AS(load({}, with(theta + 24, 2)), InputError);        // what is left of the start
  CHECK_THROWS_AS(load({}, with(saved.size() - 8, 1)), InputError);  // a bin's moment alone
}

TEST_CASE("learned mixing: merging states is absorbing all their paths") {
  const LearnedMixing policy(Settings{.objective = MixingObjective::variance});
  const auto all = policy.begin(), first = policy.begin(), second = policy.begin();
  for (const auto* state : {&all, &first, &second}) (*state)->update(2, {});
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const PathLog log = paths(kApart, 0.5f, 100, seed, seed % 2);
    all->absorb(log);
    (seed < 3 ? first : second)->absorb(log);
  }
  first->merge(*second);
  const auto expected = all->update(2, {}), found = first->update(2, {});
  for (const std::uint32_t region : {0u, 1u}) {
    CHECK(expected->unguided_fraction(region) != 0.5f);
    CHECK(found->unguided_fraction(region) ==
          doctest::Approx(expected->unguided_fraction(region)).epsilon(1e-6));
  }
  const auto other = policy.begin();
  other->update(3, {});
  CHECK_THROWS_AS(first->merge(*other), InputError);
}

TEST_CASE("learned mixing: an initial share beyond the least is refused") {
  CHECK_THROWS_AS(LearnedMixing({.initial = 0.1, .least = 0.2}), InputError);
  CHECK_THROWS_AS(LearnedMixing({.initial = 0.9, .least = 0.2}), InputError);
  CHECK_NOTHROW(LearnedMixing({.initial = 0.2, .least = 0.2}));
}

}  // namespace pharos
