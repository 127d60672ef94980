#pragma once

#include <functional>

namespace pharos {

/// Runs `work` with at most `threads` threads, more than there are cores if asked; 0: all cores.
void with_threads(int threads, const std::function<void()>& work);

}  // namespace pharos
