// Time from the start of the program to the first value of a pixel. Replaying one path does
// everything that comes before the first pixel, and writes nothing.

#include <chrono>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "bench.h"

namespace pharos::bench {

std::vector<Measurement> bench_startup(int repeats) {
  const std::string command =
      fmt::format("{} render {}/cornell-box.yaml --quiet --replay 256,256,0 > /dev/null",
                  PHAROS_PROGRAM, PHAROS_CONFIGS);
  Measurement seconds{"startup.cornell-box.first-pixel", "s", {}};
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    seconds.runs.push_back(taken.count());
  }
  return {seconds};
}

}  // namespace pharos::bench
