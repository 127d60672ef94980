#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/random.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos::test {

/// Light from two directions. Unguided sampling chooses either with density 1 and probability 0.5.
inline constexpr std::array<double, 2> kLight{0.75, 0.25};

/// Returns `count` paths of one step each. Unguided sampling has half of the samples, and the
/// guides divide the rest evenly. Guide i chooses the first direction with probability `guides[i]`;
/// if that is negative, it takes no part.
inline PathLog guided_paths(std::span<const double> guides, int count, std::uint64_t seed,
                            Vec2 film = {}) {
  const auto takes_part = [](double guide) { return guide >= 0; };
  const auto parts = std::count_if(guides.begin(), guides.end(), takes_part);
  const auto share = static_cast<float>(0.5 / static_cast<double>(parts));
  double first = 0.5 * 0.5;  // probability of the first direction
  for (const double guide : guides) first += takes_part(guide) ? share * guide : 0;
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const int chosen = random.next_1d() < first ? 0 : 1;
    std::vector<Technique> techniques{{0.5f, 1}};
    for (const double guide : guides) {
      const auto density = static_cast<float>(2 * (chosen == 0 ? guide : 1 - guide));
      techniques.push_back(takes_part(guide) ? Technique{share, density} : Technique{});
    }
    const double probability = chosen == 0 ? first : 1 - first;
    const Rgb found(static_cast<float>(kLight[chosen] / probability));
    log.begin_path(film, Transport::radiance);
    log.add(
        RecordedVertex{.kind = VertexKind::sensor, .throughput = Rgb(1), .local_weight = Rgb(1)});
    log.add(RecordedVertex{.guidable = true,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = found,
                           .pdf = static_cast<float>(2 * probability)});
    log.set_techniques(1, techniques);
    log.add(RecordedVertex{
        .parent = 1, .throughput = found, .emission = Rgb(1), .unguided_emission = Rgb(1)});
  }
  return log;
}
inline PathLog guided_paths(double guide, int count, std::uint64_t seed, Vec2 film = {}) {
  return guided_paths(std::array{guide}, count, seed, film);
}

/// Returns the exact gain of the guide; see HeldOutGain.
inline double expected_gain(double guide) {
  return kLight[0] * std::log(0.5 + guide) + kLight[1] * std::log(1.5 - guide);
}

/// Returns the exact ratio of the variances of guided and unguided paths; see NoiseRatio.
inline double expected_ratio(double guide) {
  const auto variance = [](double first) {
    return kLight[0] * kLight[0] / first + kLight[1] * kLight[1] / (1 - first) - 1;
  };
  return variance(0.5 * (0.5 + guide)) / variance(0.5);
}

}  // namespace pharos::test
