#pragma once

#include <functional>

namespace pharos {

/// Runs `work` with at most `threads` threads, which may exceed the number of cores. 0 means all
/// cores.
void with_threads(int threads, const std::function<void()>& work);

}  // namespace pharos
