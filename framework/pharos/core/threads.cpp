#include <algorithm>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/core/threads.h>

namespace pharos {

void with_threads(int threads, const std::function<void()>& work, int most_threads) {
  if (threads <= 0) return work();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(std::max(threads, most_threads)));
  tbb::task_arena(threads).execute(work);
}

}  // namespace pharos
