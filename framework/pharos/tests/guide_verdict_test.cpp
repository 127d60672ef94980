// Tests of the verdict on guides: whether they are used, and how long useless ones may learn.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/guiding/pipeline/guiding_state.h>

#include "tiny_methods.h"
#include "trial_iterations.h"
#include "two_directions.h"

namespace pharos {

using test::load_from, test::may_end, test::saved, test::tiny_settings, test::TinyMixing;

TEST_CASE("guide verdict: guides of little gain stay if they lower the noise enough") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 0.2;
  own.training.trial = 0.5;
  REQUIRE(test::expected_gain(0.8) < 0.2);
  REQUIRE(test::expected_ratio(0.8) < 0.2);
  for (const double most : {0.0, 0.5}) {
    own.training.most_noise = most;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
    state.update({0, 3});
    CHECK_FALSE(may_end(state, 0.8, 0.2, 2));
    CHECK(state.worthwhile_share() == doctest::Approx(0.5 - 0.2));  // once is not enough
    state.update({1, 2});
    CHECK_FALSE(may_end(state, 0.8, 0.25, 3));
    CHECK(state.worthwhile_share() == doctest::Approx(most > 0 ? 1 : 0.5 - 0.25));
    state.update({2, 0});
    CHECK((state.frame() == nullptr) == (most == 0));
    REQUIRE(state.gain());
    CHECK(state.gain()->is_off == (most == 0));
    REQUIRE(state.gain()->noise_ratio);
    CHECK(*state.gain()->noise_ratio ==
          doctest::Approx(test::expected_ratio(0.8)).epsilon(0.05).scale(0));
  }
}

TEST_CASE("guide verdict: nothing learns from the last iteration if guiding is off then") {
  GuidingSettings own = tiny_settings();
  const auto heard = std::make_shared<std::vector<std::string>>();
  own.mixing = std::make_shared<const TinyMixing>(0, heard);
  for (const double least : {0.01, 10.0}) {
    own.training.least_gain = least;
    heard->clear();
    GuidingState state(own, {});
    may_end(state, 0.5, 0.1, 1);
    state.update({0, 1});
    may_end(state, 0.8, 0.2, 2);
    state.update({1, 0});
    CHECK(state.gain()->is_off == (least > 1));
    CHECK(*heard ==
          std::vector<std::string>{"update", "update", least > 1 ? "end learning" : "update"});
  }
}

TEST_CASE("guide verdict: the time of guided paths counts") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.most_noise = 1;
  own.training.trial = 0.5;
  const double ratio = test::expected_ratio(0.6);
  REQUIRE(ratio > 0.5);
  // One sample per pixel takes two seconds without guides.
  for (const double cost : {0.9 / ratio, 1.1 / ratio}) {
    CAPTURE(cost);
    GuidingState state(own, {}), resumed(own, {});
    may_end(state, std::array{0.5}, {.spent = 0.1, .samples = 3, .seconds = 6}, 1);
    state.update({0, 3});
    load_from(saved(state), resumed);
    for (GuidingState* each : {&state, &resumed}) {
      for (const std::uint32_t i : {1u, 2u}) {
        may_end(*each, std::array{0.6}, {.spent = 0.2, .samples = 5, .seconds = 10 * cost}, i + 1);
        CHECK((each->worthwhile_share() == 1) == (i == 2 && cost * ratio < 1));
        each->update({i, 2 - i});
      }
      CHECK(each->gain()->is_off == (cost * ratio > 1));
    }
  }
  // A budget of samples takes the usual cost.
  for (const double most : {1.4 * ratio, 1.6 * ratio}) {
    own.training.most_noise = most;
    GuidingState state(own, {});
    may_end(state, 0.5, 0.1, 1);
    state.update({0, 3});
    may_end(state, 0.6, 0.2, 2);
    state.update({1, 0});
    CHECK(state.gain()->is_off == (most < 1.5 * ratio));
  }
}

TEST_CASE("guide verdict: the image is expected to be better than the last iteration was") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  const double ratio = test::expected_ratio(0.7);
  const auto is_off = [&](double before, double most_noise) {
    own.training.most_noise = 1.5 * most_noise;  // 1.5 is the usual cost
    GuidingState state(own, {});
    may_end(state, 0.5, 0.1, 1);
    state.update({0, 3});
    may_end(state, before, 0.1, 2);
    state.update({1, 3});
    may_end(state, 0.7, 0.1, 3);
    state.update({2, 0});
    return state.gain()->is_off;
  };
  // Half of another fall like the one from 1 to this ratio is expected.
  const double expected = ratio * std::sqrt(ratio);
  CHECK_FALSE(is_off(0.5, 1.1 * expected));
  CHECK(is_off(0.5, 0.9 * expected));
  // If the ratio has not fallen, it is not expected to fall.
  CHECK_FALSE(is_off(0.7, 1.1 * ratio));
  CHECK(is_off(0.7, 0.9 * ratio));
}

TEST_CASE(
    "guide verdict: useless guides learn on only if what may become of them is worth the time") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.most_noise = 1;
  own.training.trial = 0.1;
  const double fall = test::expected_ratio(0.7);
  const auto ends = [&](double cost) {
    GuidingState state(own, {});
    may_end(state, std::array{0.5}, {.spent = 0, .samples = 1, .seconds = 1}, 1);
    state.update({0, 9});
    may_end(state, std::array{0.5}, {.spent = 0.1, .samples = 1, .seconds = cost}, 2);
    state.update({1, 9});
    return may_end(state, std::array{0.7}, {.spent = 0.11, .samples = 1, .seconds = cost}, 3);
  };
  // Half of the last fall is expected of an image made now. All of it may follow in another
  // iteration.
  const double then = fall * std::sqrt(fall) * fall;
  CHECK_FALSE(ends(0.9 / then));
  CHECK(ends(1.1 / then));
}

TEST_CASE("guide verdict: guides that are far from useful give up after one measurement") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.most_noise = 1;
  const auto ends = [&](double cost) {
    GuidingState state(own, {});
    may_end(state, std::array{0.5}, {.spent = 0, .samples = 1, .seconds = 1}, 1);
    state.update({0, 9});
    return may_end(state, std::array{0.5}, {.spent = 0.06, .samples = 1, .seconds = cost}, 2);
  };
  // The noise may fall to e^-0.5 of what it is now.
  CHECK_FALSE(ends(1.4));
  CHECK(ends(1.7));
}

namespace {

/// Lets a state learn from paths that also find flashes that no guide draws, one in so many paths.
void absorb_flashes(GuidingState& state, int rarity, float radiance) {
  PathLog flashes;
  for (int i = 0; i < 100'000; ++i) {
    flashes.begin_path({}, Transport::radiance);
    const Rgb flash(i % rarity ? 0.0f : radiance);
    flashes.add(
        RecordedVertex{.throughput = Rgb(1), .emission = flash, .unguided_emission = flash});
  }
  state.absorb(flashes);
}

}  // namespace

TEST_CASE("guide verdict: useless guides go on if they may find what unguided images hide") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.most_noise = 1;
  GuidingState state(own, {}), resumed(own, {});
  // Images of 128 samples show about 7 % of the flashes. The noise may thus fall by the factor
  // 0.07, by its root after the second measurement, and by the root of this after the third. Guided
  // paths take 1.7 times as long, so the root of that is not enough.
  for (const std::uint32_t i : {0u, 1u, 2u, 3u, 4u}) {
    if (i == 3) load_from(saved(state), resumed);
    for (GuidingState* each : {&state, &resumed}) {
      if (i < 3 && each == &resumed) continue;
      absorb_flashes(*each, 1000, 60'000);
      const IterationCost cost{.spent = 0.06 * i, .samples = 1, .seconds = i == 0 ? 1 : 1.7};
      CHECK(may_end(*each, std::array{0.5}, cost, i) == (i == 4));
      each->update({i, 9 - i});
    }
  }
}

TEST_CASE("guide verdict: useless guides whose noise does not fall go on if the gain may suffice") {
  GuidingSettings own = tiny_settings();
  own.training.most_noise = 1;
  const double gain = test::expected_gain(0.75);
  for (const double least : {1.5 * gain, 5 * gain}) {
    own.training.least_gain = least;
    GuidingState state(own, {});
    for (const std::uint32_t i : {0u, 1u, 2u}) {
      absorb_flashes(state, 100, 60);  // they make almost all of the noise
      const std::array guide{i == 2 ? 0.75 : 0.5};
      const double cost = i == 0 ? 1 : 1.04;
      const bool ended =
          may_end(state, guide, {.spent = 0.05 * i, .samples = 1, .seconds = cost}, i);
      CHECK(ended == (i == 2 && least > 2 * gain));
      // In the same time, the noise is higher than without guides.
      if (i == 2) CHECK(*state.gain()->noise_ratio > 0.99);
      state.update({i, 9 - i});
    }
  }
}

TEST_CASE("guide verdict: a noise ratio that differs from tile to tile is uncertain") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.trial = 0.5;
  // One tile has the ratio r, the other one 1. A budget of samples takes the cost 1.5.
  const double mean = 0.5 * (1 + test::expected_ratio(0.9));
  own.training.most_noise = 1.5 * (1 + mean) / 2;
  for (const bool is_uncertain : {false, true}) {
    GuidingState state(own, {.window = {0, 0, 16, 8}});
    for (const std::uint32_t i : {0u, 1u, 2u}) {
      for (const float x : {0.0f, 8.0f}) {
        const double guide = i == 0 || (is_uncertain && x > 0) ? 0.5 : 0.9;
        for (std::uint64_t unit = 0; unit < 10; ++unit) {
          state.absorb(test::guided_paths(guide, 5000, 10 * i + unit, {x, 0}));
        }
      }
      state.may_end_training({.spent = 0.1 * (i + 1)});
      if (i == 2) CHECK((state.worthwhile_share() < 1) == is_uncertain);
      state.update({i, 9 - i});
    }
  }
}

TEST_CASE("guide verdict: a fall that is expected of the noise makes no guide surely useful") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.trial = 0.5;
  const double last = test::expected_ratio(0.7);
  // The last ratio does not suffice. After half of another fall, it would.
  own.training.most_noise = 1.5 * 0.8 * last;
  REQUIRE(std::sqrt(last) < 0.8);
  GuidingState state(own, {});
  for (const std::uint32_t i : {0u, 1u, 2u}) {
    may_end(state, i == 2 ? 0.7 : 0.5, 0.1 * (i + 1), i + 1);
    if (i == 2) CHECK(state.worthwhile_share() < 1);
    state.update({i, 2 - i});
  }
  CHECK_FALSE(state.gain()->is_off);
}

TEST_CASE("guide verdict: while hardly any light is found, training goes on in larger iterations") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.most_noise = 1;
  own.training.tolerance = 0.05;
  GuidingState state(own, {}), resumed(own, {});
  const auto find_little = [](GuidingState& each, double spent) {
    for (std::uint64_t unit = 0; unit < 100; ++unit) {
      each.absorb(test::guided_paths(std::array{0.5}, 1, unit));
    }
    return each.may_end_training({.spent = spent});
  };
  CHECK_FALSE(find_little(state, 0.1));
  CHECK(state.worthwhile_share() == doctest::Approx(0.1));
  state.update({0, 9});
  CHECK_FALSE(find_little(state, 0.15));
  CHECK(state.worthwhile_share() == doctest::Approx(2 * 0.05));
  state.update({1, 9});
  load_from(saved(state), resumed);
  for (GuidingState* each : {&state, &resumed}) {
    CHECK(each->worthwhile_share() == doctest::Approx(2 * 0.05));
    CHECK_FALSE(find_little(*each, 0.3));
    each->update({2, 0});
    CHECK(each->frame() != nullptr);  // there is no verdict
    CHECK_FALSE(each->gain());
  }
}

TEST_CASE("guide verdict: few paths with light make no noise ratio, and change no verdict") {
  GuidingSettings own = tiny_settings();
  own.training.least_gain = 10;
  own.training.most_noise = 1;
  own.training.least_part = 1;
  own.training.trial = 0.3;
  GuidingState state(own, {});
  may_end(state, 0.5, 0.1, 1);
  state.update({0, 9});
  const auto find = [&](int paths, double guide) {
    for (std::uint64_t unit = 0; unit < 100; ++unit) {
      state.absorb(test::guided_paths(std::array{guide, 0.5, -1.0}, paths / 100, unit));
    }
    return state.may_end_training({.spent = 0.2});
  };
  // Better guides than before lower the noise, but the first of them are too few to tell.
  for (const std::uint32_t i : {1u, 2u}) {
    CHECK_FALSE(find(100, 0.9));
    state.update({i, 9 - i});
    CHECK_FALSE(state.gain());
  }
  CHECK_FALSE(find(100'000, 0.9));
  CHECK(state.worthwhile_share() < 1);  // one ratio is not enough
  state.update({3, 5});
  CHECK_FALSE(find(100'000, 0.9));
  CHECK(state.worthwhile_share() == 1);
  state.update({4, 4});
  const double before = state.gain()->nats;
  CHECK_FALSE(find(100, 0.1));
  CHECK(state.worthwhile_share() == 1);
  state.update({5, 0});
  CHECK(state.gain()->nats == before);
  CHECK_FALSE(state.gain()->is_off);
}

TEST_CASE("guide verdict: a guide that hardly helps is off after training, which ends early") {
  GuidingSettings own = tiny_settings();
  for (const double least : {0.1, 0.2}) {
    REQUIRE(test::expected_gain(0.9) == doctest::Approx(0.125).epsilon(0.01));
    own.training.least_gain = least;
    own.training.trial = 0.15;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
    CHECK(state.worthwhile_share() == 0.1);  // as much as the iteration without guides
    state.update({0, 3});
    CHECK_FALSE(may_end(state, 0.5, 0.2, 2));     // there is nothing to compare with
    CHECK(state.worthwhile_share() == 0.15 / 2);  // all of the trial is spent
    state.update({1, 2});
    CHECK_FALSE(may_end(state, 0.9, 0.25, 3));  // another such rise would suffice
    CHECK(state.worthwhile_share() == (least > 0.125 ? 0.15 / 2 : 1));
    state.update({2, 1});
    CHECK(state.frame() != nullptr);         // it may still improve
    CHECK(test::expected_gain(0.8) < 0.11);  // less than before, so the gain does not rise
    CHECK(may_end(state, 0.8, 0.3, 4) == (least > 0.125));
    const std::string before = saved(*state.model(0));
    state.update({3, 0});
    CHECK((saved(*state.model(0)) == before) == (least > 0.125));  // useless guides learn no more
    CHECK((state.frame() == nullptr) == (least > 0.125));
    REQUIRE(state.gain().has_value());
    CHECK(state.gain()->is_off == (least > 0.125));
    CHECK(state.gain()->nats == doctest::Approx(test::expected_gain(0.8)).epsilon(0.05));
  }
}

}  // namespace pharos
