// Narrowing that is made up for once an iteration has enough light.

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "hole_paths.h"

namespace pharos::focal {
namespace {

using namespace testing;
using test::saved;

/// Returns the model after iterations with 3 paths each and a last one with 3000.
std::shared_ptr<const FocalModel> found_late(std::uint32_t early, int catch_up,
                                             double least_segments = 50) {
  const FocalSettings settings{
      .burn_in = 1, .catch_up = catch_up, .least_segments = least_segments};
  const auto state = FocalLearner(settings).begin(context());
  for (std::uint32_t i = 0; i < early; ++i) {
    state->absorb(hole_paths(3, i));
    state->update({i, early - i});
  }
  state->absorb(hole_paths(3000, 100));
  return std::dynamic_pointer_cast<const FocalModel>(state->update({early, 0}).model);
}

}  // namespace

TEST_CASE("focal learner: iterations with too little light are caught up with") {
  const auto late = found_late(3, 0), caught_up = found_late(3, 8);
  MESSAGE("share of directions through the hole: " << hits(*late) << ", caught up "
                                                   << hits(*caught_up));
  CHECK(hits(*caught_up) > 0.3);
  // Every missed iteration counts, up to the number that is set.
  const double one = hits(*found_late(3, 1)), two = hits(*found_late(3, 2));
  CHECK(one > 1.05 * hits(*late));
  CHECK(two > 1.02 * one);
  CHECK(hits(*caught_up) > two);
  CHECK(saved(*found_late(3, 3)) == saved(*caught_up));
  CHECK(saved(*found_late(3, 2)) != saved(*caught_up));
  // Nothing was missed, or the last iteration misses something, too.
  CHECK(saved(*found_late(3, 8, 3)) == saved(*late));
  CHECK(saved(*found_late(3, 8, 3000)) == saved(*caught_up));
  CHECK(saved(*found_late(3, 8, 3001)) == saved(*late));
}

TEST_CASE("focal learner: a few bright paths are too little light") {
  const auto model_of = [](int catch_up, float light) {
    const auto state = FocalLearner({.burn_in = 1, .catch_up = catch_up}).begin(context());
    // An iteration with too little light, for which the next one could make up.
    state->absorb(hole_paths(3, 1, 1, kCenter, 0.5f));
    state->update({0, 2});
    PathLog log = hole_paths(1000, 1);
    // 20 paths through another place.
    add_hole_paths(log, 20, 2, 1, {-1, 2, 6}, 0.5f, light);
    state->absorb(log);
    return saved(*state->update({1, 0}).model);
  };
  CHECK(model_of(8, 1000) == model_of(0, 1000));
  CHECK(model_of(8, 1) != model_of(0, 1));
}

TEST_CASE("focal learner: bright paths of one iteration do not count in the next") {
  const auto model_of = [](int catch_up) {
    const auto state = FocalLearner({.burn_in = 1, .catch_up = catch_up}).begin(context());
    PathLog bright;
    add_hole_paths(bright, 3, 1, 1, kCenter, 0.5f, 1e6f);
    state->absorb(bright);
    state->update({0, 1});
    state->absorb(hole_paths(1000, 2));
    return saved(*state->update({1, 0}).model);
  };
  CHECK(model_of(8) != model_of(0));
}

TEST_CASE("focal learner: iterations without light are caught up with") {
  const auto model_of = [](std::uint32_t dark) {
    const auto state = FocalLearner({.burn_in = 1, .catch_up = 8}).begin(context());
    for (std::uint32_t i = 0; i < dark; ++i) state->update({i, 10});
    state->absorb(hole_paths(1000, 1));
    return std::dynamic_pointer_cast<const FocalModel>(state->update({dark, 0}).model);
  };
  CHECK(hits(*model_of(1)) > 2 * hits(*model_of(0)));
  CHECK(hits(*model_of(3)) > 1.5 * hits(*model_of(1)));
}

TEST_CASE("focal learner: catching up does not go with a decay of narrowing") {
  CHECK(test::input_error([] { FocalLearner({.catch_up = 1, .narrowing_decay = 0.25f}); }) ==
        "`catch_up` needs `narrowing_decay: 0`");
}

}  // namespace pharos::focal
