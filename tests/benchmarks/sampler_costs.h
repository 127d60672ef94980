#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pharos/sampling/sampler.h>

#include "bench.h"

namespace pharos::bench {

/// The film and the plan for which numbers are timed.
inline constexpr PixelGrid kTimedFilm{1280, 720};
inline constexpr SamplePlan kTimedPlan{.seed = 1, .samples_per_pixel = 64};

/// Returns the processor time of this thread [ns], which excludes the time of other programs.
double thread_ns();

/// Prevents the compiler from optimizing a result away.
void keep(float result);

/// Returns the mean time [ns] of a path. For each path, `use` computes a number from the path's
/// stream. The paths run through a tile of the film in the same order as in a render: pixel by
/// pixel, all samples of each.
template <class Use>
double time_paths(const PreparedSampler& sampler, Use&& use) {
  constexpr int kTile = 64, kFirst = 320;
  const double start = thread_ns();
  float sum = 0;
  for (int pixel = 0; pixel < kTile * kTile; ++pixel) {
    const int x = kFirst + pixel % kTile, y = kFirst + pixel / kTile;
    PathKey key{.seed = kTimedPlan.seed,
                .index = static_cast<std::uint64_t>(y * kTimedFilm.width + x)};
    for (key.sample = 0; key.sample < kTimedPlan.samples_per_pixel; ++key.sample) {
      sum += use(SampleStream(sampler, key));
    }
  }
  keep(sum);
  return (thread_ns() - start) / (kTile * kTile * kTimedPlan.samples_per_pixel);
}

/// Measures the costs of a sampler's numbers on one thread. `sampler.NAME.value_ns` is the time of
/// a 2D number, for paths that ask for eleven: one for the pixel, and one each for a light and a
/// BSDF at five vertices. This time includes a share of the beginning of the path's stream.
/// `begin_ns` is the time of the beginning alone. `allocations` is the number of blocks taken from
/// the heap after prepare(). The sampler must not need a probe.
std::vector<Measurement> measure_sampler(const std::string& name, const Sampler& sampler,
                                         int repeats);

}  // namespace pharos::bench
