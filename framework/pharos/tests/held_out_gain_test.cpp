// Tests of the measure that ends training, on steps with two possible directions.

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/guiding/pipeline/held_out_gain.h>

#include "two_directions.h"

namespace pharos::test {
namespace {

/// Ends an iteration of 100 work units.
bool settles(HeldOutGain& gain, double guide, int count, std::uint64_t seed, double tolerance) {
  for (std::uint64_t unit = 0; unit < 100; ++unit) {
    gain.absorb(guided_paths(guide, count, hash_combine(seed, unit)));
  }
  return gain.end_iteration(tolerance);
}

TEST_CASE("held-out gain: the difference of two divergences") {
  HeldOutGain gain;
  for (const double guide : {0.5, 0.75, 0.99}) {
    settles(gain, guide, 1000, 1, 0);
    CHECK(gain.value() == doctest::Approx(expected_gain(guide)).epsilon(0.01).scale(0.1));
  }
}

TEST_CASE("held-out gain: training settles when guides improve no further, and not by chance") {
  HeldOutGain gain;
  CHECK_FALSE(settles(gain, 0.5, 1000, 1, 0.02));  // there is nothing to compare with
  CHECK_FALSE(settles(gain, 0.9, 1000, 2, 0.02));  // a rise
  CHECK(settles(gain, 0.9, 1000, 3, 0.02));        // none
  CHECK_FALSE(settles(gain, 0.9, 1, 4, 0.02));     // too few paths to know
  CHECK_FALSE(settles(gain, 0.9, 1000, 6, 1e-4));  // a rise that is smaller than the noise
  CHECK_FALSE(settles(gain, 0.5, 1000, 7, 0.02));  // worse than before, for now
}

TEST_CASE("held-out gain: whether it suffices, or will if it rises by as much again") {
  HeldOutGain gain;
  settles(gain, 0.5, 1000, 1, 0);
  CHECK(gain.is_below(0.1));
  CHECK_FALSE(gain.is_below(-0.1));
  CHECK(gain.may_reach(100));  // there is nothing to compare with
  settles(gain, 0.9, 1000, 2, 0);
  CHECK(gain.may_be_below(gain.value()));  // because it is uncertain
  CHECK_FALSE(gain.may_be_below(gain.value() - 0.1));
  const double rise = expected_gain(0.9) - expected_gain(0.5);
  CHECK(gain.may_reach(expected_gain(0.9) + 0.9 * rise));
  CHECK_FALSE(gain.may_reach(expected_gain(0.9) + 1.1 * rise));
  settles(gain, 0.5, 1000, 3, 0);
  CHECK_FALSE(gain.may_reach(expected_gain(0.5) + 0.1));  // a fall counts as no rise
  CHECK(gain.may_reach(expected_gain(0.5) - 0.1));
}

TEST_CASE("held-out gain: iterations without light tell nothing") {
  HeldOutGain gain;
  settles(gain, 0.9, 1000, 1, 0.02);
  CHECK_FALSE(gain.end_iteration(0.02));
  CHECK_FALSE(gain.is_below(100));
  CHECK_FALSE(settles(gain, 0.9, 1000, 2, 0.02));
  CHECK(settles(gain, 0.9, 1000, 3, 0.02));
}

TEST_CASE("held-out gain: saved in the middle of an iteration, it ends the same") {
  HeldOutGain gain, resumed;
  settles(gain, 0.9, 100, 1, 0.02);
  gain.absorb(guided_paths(0.9, 100, 2));
  std::ostringstream out;
  save(out, gain);
  std::istringstream in(out.str());
  load(in, resumed);
  CHECK(resumed.end_iteration(0.05) == gain.end_iteration(0.05));
  CHECK(resumed.value() == gain.value());
}

}  // namespace
}  // namespace pharos::test
