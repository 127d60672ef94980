#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/random.h>
#include <pharos/guiding/record/path_record.h>

#include "../finds.h"

/// A world in which mixing policies learn, and whose best shares are known.
namespace pharos::testing {

/// A world of three directions. It holds the probability that each sampler gives to each direction,
/// and the value that is sought there.
struct World {
  std::array<double, 3> unguided, guided, sought;

  double mixed(std::size_t i, double share) const {
    return share * unguided[i] + (1 - share) * guided[i];
  }
};

/// Each sampler finds what the other one misses.
inline constexpr World kApart{{0.5, 0.5, 0}, {0, 0, 1}, {0.3, 0, 0.7}};
/// No mixture is perfect.
inline constexpr World kOverlapping{{0.7, 0.2, 0.1}, {0.3, 0.1, 0.6}, {0.1, 0.5, 0.4}};
inline constexpr World kGuideMisses{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
inline constexpr World kOnlyGuideFinds{{1, 0, 0}, {0, 1, 0}, {0, 1, 0}};

inline std::size_t choose(const std::array<double, 3>& probabilities, double u) {
  std::size_t i = 0;
  while (i < 2 && u >= probabilities[i]) u -= probabilities[i++];
  return i;
}

/// Adds a path with one step whose estimate is `found` times the radiance 1.
inline void add_path(PathLog& log, std::uint32_t mixing_key, std::span<const Technique> techniques,
                     double found, Point3 at = {}) {
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .local_weight = Rgb(1)});
  float pdf = 0;
  for (const Technique& t : techniques) pdf += t.share * t.density;
  log.add(RecordedVertex{.position = at,
                         .guidable = true,
                         .parent = 0,
                         .local_weight = Rgb(static_cast<float>(found)),
                         .pdf = pdf,
                         .mixing_key = mixing_key});
  log.set_techniques(1, techniques);
  log.add(RecordedVertex{.parent = 1, .emission = Rgb(1)});
}

/// Returns paths of one step each, drawn from the mixture with the given share. `scale` is the unit
/// of radiance. `guides` methods share the guided samples evenly. The steps begin at `at`.
inline PathLog paths(const World& world, float share, int count, std::uint64_t seed,
                     std::uint32_t mixing_key = 0, double scale = 1, std::size_t guides = 1,
                     Point3 at = {}) {
  PathLog log;
  RandomStream random(seed);
  for (int k = 0; k < count; ++k) {
    const bool unguided = random.next_1d() < share;
    const std::size_t i = choose(unguided ? world.unguided : world.guided, random.next_1d());
    const Technique guide{(1 - share) / static_cast<float>(guides),
                          static_cast<float>(world.guided[i])};
    std::vector<Technique> techniques(1 + guides, guide);
    techniques[0] = {share, static_cast<float>(world.unguided[i])};
    add_path(log, mixing_key, techniques, scale * world.sought[i] / world.mixed(i, share), at);
  }
  return log;
}

inline double objective(const World& world, double share, MixingObjective which) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double f = world.sought[i], q = world.mixed(i, share);
    if (f > 0) sum += which == MixingObjective::kl ? -f * std::log(q) : f * f / q;
  }
  return sum;
}

/// Finds the best share by trying all of them.
inline double best_share(const World& world, MixingObjective which) {
  double best = 0.5;
  for (double share = 0.001; share < 1; share += 0.001) {
    if (objective(world, share, which) < objective(world, best, which)) best = share;
  }
  return best;
}

}  // namespace pharos::testing
