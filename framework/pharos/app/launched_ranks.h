#pragma once

#include <functional>

#include <pharos/rendering/ranks.h>

namespace pharos {

/// Runs `work` together with the other processes that mpirun or srun has started, or with null if
/// this process is alone. It has `threads` threads, as with_threads(); 0 means that the ranks of a
/// machine share its cores. When `work` has ended in any way, rank 0 sends the others home. Throws
/// InputError if this build has no MPI part, or if the processes do not find each other.
void with_launched_ranks(int threads, const std::function<void(Ranks*)>& work);

}  // namespace pharos
