#pragma once

#include <ctime>

namespace pharos::bench {

/// Returns the processor time of this thread [ns], which excludes the time of other programs.
inline double thread_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

}  // namespace pharos::bench
