// What point sets with low energy in stated directions cost: `synthesis_s.N` is the time, on all
// cores, of a set of N points with one direction beside the axes.

#include <aligned_sampling/synthesis.h>
#include <chrono>

#include <fmt/format.h>

#include "bench.h"

namespace pharos::bench {

std::vector<Measurement> bench_aligned(int repeats) {
  aligned::SynthesisSettings settings;
  settings.points = 4096;
  settings.directions = {30};
  Measurement seconds{fmt::format("aligned.synthesis_s.{}", settings.points), "s", {}};
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    aligned::synthesize(settings);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    seconds.runs.push_back(taken.count());
  }
  return {seconds};
}

}  // namespace pharos::bench
