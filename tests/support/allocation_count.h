#pragma once

#include <cstdint>

namespace pharos::testing {

/// Blocks that the calling thread has taken from the heap by `operator new` so far, modules
/// included: the program replaces it.
std::uint64_t allocation_count();

}  // namespace pharos::testing
