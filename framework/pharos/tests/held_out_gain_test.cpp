// Tests of the measure that ends training, on steps with two possible directions.

#include <array>
#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/guiding/pipeline/held_out_gain.h>

#include "two_directions.h"

namespace pharos::test {
namespace {

/// Ends an iteration of 100 work units.
void iterate(HeldOutGain& gain, double guide, int count, std::uint64_t seed) {
  for (std::uint64_t unit = 0; unit < 100; ++unit) {
    gain.absorb(guided_paths(guide, count, hash_combine(seed, unit)));
  }
  gain.end_iteration();
}

TEST_CASE("held-out gain: the difference of two divergences") {
  HeldOutGain gain;
  for (const double guide : {0.5, 0.75, 0.99}) {
    iterate(gain, guide, 1000, 1);
    CHECK(gain.value() == doctest::Approx(expected_gain(guide)).epsilon(0.01).scale(0.1));
  }
}

TEST_CASE("held-out gain: it may rise by as much again, and by a standard error") {
  HeldOutGain gain;
  iterate(gain, 0.5, 1000, 1);
  CHECK(std::isinf(gain.possible_rise()));  // there is nothing to compare with
  iterate(gain, 0.9, 1000, 2);
  const double rise = expected_gain(0.9) - expected_gain(0.5);
  CHECK(gain.possible_rise() == doctest::Approx(rise).epsilon(0.05));
  iterate(gain, 0.9, 1000, 3);
  CHECK(std::abs(gain.possible_rise()) < 0.02);
  iterate(gain, 0.9, 5, 4);  // few paths make an uncertain estimate
  CHECK(gain.possible_rise() > 0.02);
  iterate(gain, 0.9, 1000, 5);
  iterate(gain, 0.5, 1000, 6);
  CHECK(gain.possible_rise() == doctest::Approx(-rise).epsilon(0.05));
}

TEST_CASE("held-out gain: the parts of methods") {
  HeldOutGain gain;
  for (std::uint64_t unit = 0; unit < 100; ++unit) {
    gain.absorb(guided_paths(std::array{0.9, 0.5, -1.0}, 1000, unit));
  }
  CHECK(gain.parts().empty());
  gain.end_iteration();
  // Without the first method, unguided sampling remains. Without the second, the first has a third
  // of the samples.
  const auto gain_with = [](double share) {
    return kLight[0] * std::log(1 + 0.8 * share) + kLight[1] * std::log(1 - 0.8 * share);
  };
  REQUIRE(gain.parts().size() == 3);
  CHECK(gain.value() == doctest::Approx(gain_with(0.25)).epsilon(0.02));
  CHECK(gain.parts()[0].nats == doctest::Approx(gain_with(0.25)).epsilon(0.02));
  CHECK(gain.parts()[1].nats ==
        doctest::Approx(gain_with(0.25) - gain_with(1.0 / 3)).epsilon(0.05).scale(0.01));
  CHECK(gain.parts()[1].is_known);
  CHECK_FALSE(gain.parts()[2].is_known);  // it took no part
}

TEST_CASE("held-out gain: the part of a method that is almost the whole density") {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{
      .guidable = true, .throughput = Rgb(1), .local_weight = Rgb(1), .pdf = 0.5e9f});
  log.set_techniques(0, std::array{Technique{0.5f, 1}, Technique{0.5f, 1e9f}});
  log.add(RecordedVertex{.parent = 0, .emission = Rgb(1)});
  HeldOutGain gain;
  for (int unit = 0; unit < 300; ++unit) gain.absorb(log);
  gain.end_iteration();
  CHECK(gain.parts()[0].nats == doctest::Approx(std::log(0.5e9)));
}

TEST_CASE("held-out gain: whether it suffices, or may if it rises by as much again") {
  HeldOutGain gain;
  iterate(gain, 0.5, 1000, 1);
  CHECK(gain.is_below(0.1));
  CHECK_FALSE(gain.is_below(-0.1));
  CHECK(gain.may_reach(100));  // there is nothing to compare with
  iterate(gain, 0.9, 1000, 2);
  CHECK(gain.may_be_below(gain.value()));  // because it is uncertain
  CHECK_FALSE(gain.may_be_below(gain.value() - 0.1));
  const double rise = expected_gain(0.9) - expected_gain(0.5);
  CHECK(gain.may_reach(expected_gain(0.9) + 0.9 * rise));
  CHECK_FALSE(gain.may_reach(expected_gain(0.9) + 1.1 * rise));
  iterate(gain, 0.5, 1000, 3);
  CHECK_FALSE(gain.may_reach(expected_gain(0.5) + 0.1));  // a fall counts as no rise
  CHECK(gain.may_reach(expected_gain(0.5) - 0.1));
}

TEST_CASE("held-out gain: it may rise by a standard error more") {
  HeldOutGain gain;
  iterate(gain, 0.5, 5, 4);
  iterate(gain, 0.9, 5, 5);
  REQUIRE(gain.possible_rise() > 1.05 * gain.rise());
  CHECK(gain.may_reach(gain.value() + 0.5 * (gain.rise() + gain.possible_rise())));
  CHECK_FALSE(gain.may_reach(gain.value() + 1.01 * gain.possible_rise()));
}

TEST_CASE("held-out gain: iterations without light tell nothing") {
  HeldOutGain gain;
  iterate(gain, 0.9, 1000, 1);
  gain.end_iteration();
  CHECK(gain.value() == doctest::Approx(expected_gain(0.9)).epsilon(0.05));
  CHECK(std::isinf(gain.possible_rise()));
  iterate(gain, 0.9, 1000, 2);
  CHECK(std::abs(gain.possible_rise()) < 0.02);
}

TEST_CASE("held-out gain: few paths with light tell nothing until others join them") {
  HeldOutGain gain;
  const auto absorb = [&](double guide, int paths) {
    for (const std::uint64_t unit : {1u, 2u}) gain.absorb(guided_paths(guide, paths / 2, unit));
    return gain.end_iteration();
  };
  CHECK_FALSE(absorb(0.5, 254));
  CHECK_FALSE(gain.is_known());
  CHECK_FALSE(gain.is_below(100));
  CHECK(gain.may_be_below(-100));
  CHECK(gain.parts().empty());
  CHECK(absorb(0.5, 2));
  CHECK(gain.is_below(0.01));
  CHECK_FALSE(gain.may_be_below(-0.01));
  CHECK(gain.parts().size() == 1);
  CHECK_FALSE(absorb(0.9, 128));
  CHECK(gain.value() == 0);  // the guide 0.5 is as good as none
  CHECK(absorb(0.9, 128));
  CHECK(gain.value() > 0.05);
}

TEST_CASE("held-out gain: saved in the middle of an iteration, it ends the same") {
  HeldOutGain gain, resumed;
  iterate(gain, 0.9, 100, 1);
  gain.absorb(guided_paths(0.9, 100, 2));
  std::ostringstream out;
  save(out, gain);
  std::istringstream in(out.str());
  load(in, resumed);
  for (HeldOutGain* each : {&gain, &resumed}) each->end_iteration();
  CHECK(resumed.value() == gain.value());
  CHECK(resumed.possible_rise() == gain.possible_rise());
  CHECK(resumed.parts()[0].nats == gain.parts()[0].nats);
}

}  // namespace
}  // namespace pharos::test
