// Tests of the measure that ends training, on steps with two possible directions.

#include <array>
#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/guiding/pipeline/held_out_gain.h>

namespace pharos {
namespace {

/// Light from two directions. Unguided sampling chooses either with density 1 and probability 0.5.
constexpr std::array<double, 2> kLight{0.75, 0.25};

/// Returns `count` paths of one step each. A guide that has half of the samples chooses the first
/// direction with probability `guide`.
PathLog guided_paths(double guide, int count, std::uint64_t seed) {
  PathLog log;
  RandomStream random(seed);
  const double first = 0.5 * (0.5 + guide);  // probability of the first direction
  for (int i = 0; i < count; ++i) {
    const int chosen = random.next_1d() < first ? 0 : 1;
    const auto own = static_cast<float>(2 * (chosen == 0 ? guide : 1 - guide));
    const std::array techniques{Technique{0.5f, 1}, Technique{0.5f, own}};
    const double probability = chosen == 0 ? first : 1 - first;
    log.begin_path({}, Transport::radiance);
    log.add(
        RecordedVertex{.kind = VertexKind::sensor, .throughput = Rgb(1), .local_weight = Rgb(1)});
    log.add(RecordedVertex{.guidable = true,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(static_cast<float>(kLight[chosen] / probability)),
                           .pdf = 0.5f + 0.5f * own});
    log.set_techniques(1, techniques);
    log.add(RecordedVertex{.parent = 1, .emission = Rgb(1)});
  }
  return log;
}

/// Ends an iteration of 100 work units.
bool settles(HeldOutGain& gain, double guide, int count, std::uint64_t seed, double tolerance) {
  for (std::uint64_t unit = 0; unit < 100; ++unit) {
    gain.absorb(guided_paths(guide, count, hash_combine(seed, unit)));
  }
  return gain.settles(tolerance);
}

/// The exact gain.
double expected(double guide) {
  return kLight[0] * std::log(0.5 + guide) + kLight[1] * std::log(1.5 - guide);
}

TEST_CASE("held-out gain: the difference of two divergences") {
  HeldOutGain gain;
  for (const double guide : {0.5, 0.75, 0.99}) {
    settles(gain, guide, 1000, 1, 0);
    CHECK(gain.value() == doctest::Approx(expected(guide)).epsilon(0.01).scale(0.1));
  }
}

TEST_CASE("held-out gain: training settles when guides improve no further, and not by chance") {
  HeldOutGain gain;
  CHECK_FALSE(settles(gain, 0.5, 1000, 1, 0.02));  // there is nothing to compare with
  CHECK_FALSE(settles(gain, 0.9, 1000, 2, 0.02));  // a rise
  CHECK(settles(gain, 0.9, 1000, 3, 0.02));        // none
  CHECK_FALSE(settles(gain, 0.9, 1, 4, 0.02));     // too few paths to know
  CHECK_FALSE(settles(gain, 0.9, 1000, 6, 1e-4));  // a rise that is smaller than the noise
  CHECK(settles(gain, 0.5, 1000, 7, 0.02));        // worse than before
}

TEST_CASE("held-out gain: iterations without light tell nothing") {
  HeldOutGain gain;
  settles(gain, 0.9, 1000, 1, 0.02);
  CHECK_FALSE(gain.settles(0.02));
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
  CHECK(resumed.settles(0.05) == gain.settles(0.05));
  CHECK(resumed.value() == gain.value());
}

}  // namespace
}  // namespace pharos
