#pragma once

#include <cstdint>

namespace pharos::testing {

/// Returns the number of blocks that the calling thread has taken from the heap by `operator new`.
/// Allocations of modules count, too, because the program replaces the operator.
std::uint64_t allocation_count();

}  // namespace pharos::testing
