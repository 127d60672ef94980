#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pharos/sampling/sampler.h>

#include "bench.h"

namespace pharos::bench {

/// What is rendered where numbers are timed.
inline constexpr PixelGrid kTimedFilm{1280, 720};
inline constexpr SamplePlan kTimedPlan{.seed = 1, .samples_per_pixel = 64};

/// Processor time of this thread [ns]: what other programs take does not count.
double thread_ns();

/// Keeps a result from being optimized away.
void keep(float result);

/// The mean time [ns] of paths, of which `use` makes a number from the path's stream. They run
/// through a tile of the film as a render does: pixel by pixel, all samples of each.
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

/// What numbers of a sampler cost: `sampler.NAME.value_ns` is the time of a 2D number on one
/// thread, of paths that ask for eleven: the pixel's, and those of a light and a BSDF at five
/// vertices. A path's share of beginning its stream is in it; `begin_ns` is that beginning by
/// itself. `allocations` counts blocks taken from the heap after prepare(). The sampler must not
/// need a probe.
std::vector<Measurement> measure_sampler(const std::string& name, const Sampler& sampler,
                                         int repeats);

}  // namespace pharos::bench
