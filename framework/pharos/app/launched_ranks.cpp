#include "launched_ranks.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <pharos/core/error.h>
#include <pharos/core/threads.h>
#include <pharos/rendering/mpi_ranks.h>
#include <pharos/rendering/rank_leader.h>

namespace pharos {
namespace {

constexpr const char* kMpiLibrary = "libpharos_mpi.so";

/// Returns the number of processes that were started together. Open MPI's mpirun, the mpirun of
/// MPICH and Slurm's srun each set a variable of their own.
int launched_count() {
  int count = 1;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* const text = std::getenv(name);
    if (text == nullptr) continue;
    int found = 0;
    const std::string_view digits(text);
    std::from_chars(digits.data(), digits.data() + digits.size(), found);
    count = std::max(count, found);
  }
  return count;
}

/// Loads the MPI library from the folder of libpharos, and joins the other processes.
std::unique_ptr<Ranks> join(int launched) {
  Dl_info here;
  dladdr(reinterpret_cast<const void*>(&dismiss_helpers), &here);
  const std::filesystem::path file =
      std::filesystem::path(here.dli_fname).parent_path() / kMpiLibrary;
  // The plugins of Open MPI look for its functions among those that are visible to all.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* entry = library == nullptr ? nullptr : dlsym(library, "pharos_mpi_ranks");
  if (entry == nullptr) {
    throw InputError(
        fmt::format("pharos: error: {} processes were started, but this build has no MPI part "
                    "('./run --with-mpi {} render CONFIG' builds it): {}",
                    launched, launched, one_line(dlerror())));
  }
  std::unique_ptr<Ranks> ranks(reinterpret_cast<decltype(&pharos_mpi_ranks)>(entry)());
  if (ranks->count() == 1) {
    throw InputError(
        fmt::format("pharos: error: {} processes were started, but they do not find each other; "
                    "with Slurm, use 'srun --mpi=pmix' (or pmi2)",
                    launched));
  }
  return ranks;
}

/// Runs `work` with `threads` threads, or with this rank's part of its cores if that is 0. While
/// the other ranks on these cores are idle, it may use theirs.
void with_threads_of(const Ranks& ranks, int threads, const std::function<void()>& work) {
  const int cores = tbb::this_task_arena::max_concurrency(), sharers = ranks.count_on_cores();
  const int own = threads > 0 ? threads : std::max(1, cores / sharers);
  with_threads(own, work, std::min(cores, own * sharers));
}

}  // namespace

void with_launched_ranks(int threads, const std::function<void(Ranks*)>& work) {
  const int launched = launched_count();
  if (launched == 1) return with_threads(threads, [&] { work(nullptr); });
  const std::unique_ptr<Ranks> ranks = join(launched);
  // The last rank to be needed is rank 0.
  const auto dismiss = [&](Ranks* leader) {
    if (leader->rank() == 0) dismiss_helpers(*leader);
  };
  const std::unique_ptr<Ranks, decltype(dismiss)> at_end(ranks.get(), dismiss);
  with_threads_of(*ranks, threads, [&] { work(ranks.get()); });
}

}  // namespace pharos
