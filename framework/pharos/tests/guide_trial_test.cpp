// Tests of the decisions on trial: when training ends, and which methods go on.

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/guiding/pipeline/guiding_state.h>

#include "tiny_methods.h"
#include "trial_iterations.h"
#include "two_directions.h"

namespace pharos {
namespace {

using test::Methods, test::TinyMixing, test::asked_methods, test::load_from, test::may_end,
    test::saved, test::tiny_settings;

/// The first method helps, the second does nothing, and the third harms.
constexpr std::array kUnequal{0.9, 0.5, 0.1};

}  // namespace

TEST_CASE("guide trial: training ends when another iteration does not pay, or goes on") {
  GuidingSettings own = tiny_settings();
  for (const double tolerance : {0.0, 0.02}) {
    own.training.tolerance = tolerance;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
    state.update({0, 1});
    CHECK_FALSE(may_end(state, 0.5, 0.12, 2));  // there is nothing to compare with
    state.update({1, 1});
    CHECK_FALSE(may_end(state, 0.9, 0.14, 3));  // a rise
    state.update({2, 1});
    CHECK(may_end(state, 0.9, 0.16, 4) == (tolerance > 0));  // none
    state.update({3, 0});
    CHECK(state.frame() != nullptr);
  }
}

TEST_CASE("guide trial: the more another iteration costs, the more it must promise") {
  GuidingSettings own = tiny_settings();
  own.training.tolerance = 0.001;
  own.training.trial = 0;
  own.training.share = 0.9;
  own.training.schedule = ScheduleKind::geometric;
  // The noise falls to 0.647, and the gain rises by less than it would have to for as much. Half of
  // the fall is expected to follow.
  const double last_fall = -std::log(test::expected_ratio(0.6)), fall = 0.5 * last_fall;
  REQUIRE(test::expected_gain(0.6) - test::expected_gain(0.5) < last_fall);
  const auto ends = [&](double time) {
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0, 1));
    state.update({0, 1});
    CHECK_FALSE(may_end(state, 0.5, 0, 2));
    state.update({1, 1});
    return may_end(state, 0.6, time, 3);
  };
  // After t, the next iteration takes 2 t, or all that is left if 4 t would not fit after it.
  REQUIRE(std::log((1 - 0.1 - 0.1) / (1 - 0.1 - 0.2)) < 0.9 * fall);
  CHECK_FALSE(ends(0.1));
  REQUIRE(std::log((1 - 0.25 - 0.325) / (1 - 0.25 - 0.65)) > 1.1 * fall);
  CHECK(ends(0.25));
  // If images are discarded, all of the time is lost.
  own.training.images = TrainingImages::discard;
  REQUIRE(std::log((1 - 0.2) / (1 - 0.2 - 0.7)) > 1.1 * fall);
  CHECK(ends(0.2));
  CHECK_FALSE(ends(0.05));
  // A uniform schedule goes on with as much as the last time.
  own.training.schedule = ScheduleKind::uniform;
  REQUIRE(std::log((1 - 0.1) / (1 - 0.1 - 0.1)) < 0.9 * fall);
  CHECK_FALSE(ends(0.1));
  REQUIRE(std::log((1 - 0.2) / (1 - 0.2 - 0.2)) > 1.1 * fall);
  CHECK(ends(0.2));
}

TEST_CASE("guide trial: methods that the guides can do without are left out, one by one") {
  GuidingSettings own = tiny_settings();
  own.training.least_part = 0.01;
  GuidingState state(own, {}), resumed(own, {});
  CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
  state.update({0, 9});
  may_end(state, kUnequal, 0.2, 2);
  state.update({1, 8});
  const std::string early = saved(state);
  CHECK(asked_methods(state) == Methods{0, 1, 2});  // once is not enough
  may_end(state, kUnequal, 0.3, 3);
  state.update({2, 7});
  CHECK(asked_methods(state) == Methods{0, 1});
  load_from(saved(state), resumed);
  for (GuidingState* each : {&state, &resumed}) {
    const std::string out = saved(*each->model(2)), in = saved(*each->model(0));
    may_end(*each, std::array{0.9, 0.5, -1.0}, 0.35, 4);
    each->update({3, 6});
    CHECK(asked_methods(*each) == Methods{0});
    CHECK(saved(*each->model(2)) == out);  // it learns no more
    // The second method is out, too, but it shares the model of the first.
    CHECK(saved(*each->model(0)) != in);
    for (const std::uint32_t i : {4u, 5u, 6u}) {
      may_end(*each, std::array{0.2, -1.0, -1.0}, 0.4, i);
      each->update({i, 6 - i});
    }
    CHECK(asked_methods(*each) == Methods{0});  // the last one stays
  }
  CHECK(saved(state) == saved(resumed));
  load_from(early, resumed);
  CHECK(asked_methods(resumed) == Methods{0, 1, 2});
}

TEST_CASE("guide trial: no method is left out on trial, by useless guides, or if none is to be") {
  const auto asked = [](double least_part, double least_gain, double spent) {
    GuidingSettings own = tiny_settings();
    own.training.tolerance = 1e-9;
    own.training.least_part = least_part;
    own.training.least_gain = least_gain;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0, 1));
    state.update({0, 9});
    for (const std::uint32_t i : {1u, 2u}) {
      may_end(state, kUnequal, i == 2 ? spent : 0, i);
      state.update({i, 9});
    }
    return asked_methods(state);
  };
  CHECK(asked(0.01, 0, 0.1) == Methods{0, 1});
  CHECK(asked(0.01, 0, 0.02) == Methods{0, 1, 2});
  CHECK(asked(0.01, 0.5, 0.1) == Methods{0, 1, 2});
  CHECK(asked(0, 0, 0.1) == Methods{0, 1, 2});
}

TEST_CASE("guide trial: the policy hears of a method that is left out, before its update") {
  GuidingSettings own = tiny_settings();
  own.training.least_part = 0.01;
  const auto heard = std::make_shared<std::vector<std::string>>();
  own.mixing = std::make_shared<const TinyMixing>(0, heard);
  GuidingState state(own, {});
  CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
  state.update({0, 9});
  for (const std::uint32_t i : {1u, 2u}) {
    may_end(state, kUnequal, 0.2, i);
    state.update({i, 9});
  }
  CHECK(*heard == std::vector<std::string>{"update", "update", "update", "leave out 2", "update"});
}

}  // namespace pharos
