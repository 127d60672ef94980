#include <algorithm>
#include <fstream>
#include <malloc.h>
#include <string>

#include <pharos/experiments/runner/peak_memory.h>

namespace pharos {

PeakMemory::PeakMemory() {
  malloc_trim(0);  // memory that earlier work has freed must not count
  reset();
}

std::optional<double> PeakMemory::bytes() {
  take();
  if (!known_) return std::nullopt;
  return peak_;
}

void PeakMemory::reset() {
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5" << std::flush;  // resets the peak, see proc(5)
  known_ = known_ && static_cast<bool>(refs);
}

void PeakMemory::take() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0;
    if (word == "VmHWM:" && status >> kibibytes) peak_ = std::max(peak_, kibibytes * 1024);
  }
  known_ = known_ && peak_ > 0;
}

}  // namespace pharos
