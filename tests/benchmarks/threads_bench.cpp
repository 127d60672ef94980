// Speedup of two threads over one, measured in turns.

#include <fmt/format.h>

#include "bench.h"
#include "renders.h"

namespace pharos::bench {

std::vector<Measurement> bench_threads(int repeats) {
  const std::string config = fmt::format(
      "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 256, height: 256, filter: box }}\n"
      "sampler: independent\nintegrator: {{ type: path, max_depth: 10 }}\nbudget: {{ spp: 16 }}\n",
      PHAROS_SCENES);
  Measurement speedup{"threads.1to2.speedup", "1", {}};
  for (int i = 0; i < repeats; ++i) {
    const double one = testing::render(config, 1).times.rendering;
    const double two = testing::render(config, 2).times.rendering;
    speedup.runs.push_back(one / two);
  }
  return {speedup};
}

}  // namespace pharos::bench
