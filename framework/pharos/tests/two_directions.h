#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <pharos/core/random.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::test {

/// Light from two directions. Unguided sampling chooses either with density 1 and probability 0.5.
inline constexpr std::array<double, 2> kLight{0.75, 0.25};

/// Returns `count` paths of one step each. A guide that has half of the samples chooses the first
/// direction with probability `guide`.
inline PathLog guided_paths(double guide, int count, std::uint64_t seed) {
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

/// Returns the exact gain of the guide; see HeldOutGain.
inline double expected_gain(double guide) {
  return kLight[0] * std::log(0.5 + guide) + kLight[1] * std::log(1.5 - guide);
}

}  // namespace pharos::test
