#include <fstream>

#include <tbb/task_arena.h>

#include <pharos/experiments/runner/machine.h>

namespace pharos {

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != line.npos) return line.substr(colon + 2);
  }
  return {};
}

}  // namespace pharos
