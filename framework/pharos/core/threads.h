#pragma once

#include <functional>

namespace pharos {

/// Runs `work` with at most `threads` threads, which may exceed the number of cores. 0 means all
/// cores. Arenas that `work` makes may use up to `most_threads`, if that is more.
void with_threads(int threads, const std::function<void()>& work, int most_threads = 0);

}  // namespace pharos
