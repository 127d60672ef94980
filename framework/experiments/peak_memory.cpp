#include <fstream>
#include <malloc.h>
#include <string>

#include <pharos/experiments/peak_memory.h>

namespace pharos {
namespace {

bool was_reset = false;

}  // namespace

void reset_peak_memory() {
  malloc_trim(0);  // what earlier work has freed is not this one's
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5" << std::flush;  // see proc(5)
  was_reset = static_cast<bool>(refs);
}

std::optional<double> peak_memory() {
  if (!was_reset) return std::nullopt;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0;
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
}

}  // namespace pharos
