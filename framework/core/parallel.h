#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace pharos {

/// Runs `produce(i)` for i = 0, 1, … concurrently and `consume(i, result)` strictly in order of i,
/// one at a time. What consume() folds is therefore the same for any number of threads. At most
/// about four results a thread wait at once, so memory stays bounded. The loop ends at `count`,
/// or early at the first i for which `keep_going(i)` is false; every i below that is consumed.
template <class Produce, class Consume, class KeepGoing>
void parallel_ordered(std::size_t count, Produce&& produce, Consume&& consume,
                      KeepGoing&& keep_going) {
  using Result = decltype(produce(std::size_t{0}));
  struct Item {
    std::size_t index;
    Result result;
  };
  using ItemPtr = std::shared_ptr<Item>;
  const auto tokens = 4 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& flow) -> std::size_t {
    if (next < count && keep_going(next)) return next++;
    flow.stop();
    return 0;
  };
  const auto work = [&](std::size_t i) { return ItemPtr(new Item{i, produce(i)}); };
  const auto fold = [&](const ItemPtr& item) { consume(item->index, item->result); };
  tbb::parallel_pipeline(
      tokens, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, number) &
                  tbb::make_filter<std::size_t, ItemPtr>(tbb::filter_mode::parallel, work) &
                  tbb::make_filter<ItemPtr, void>(tbb::filter_mode::serial_in_order, fold));
}

/// As above, always to the end.
template <class Produce, class Consume>
void parallel_ordered(std::size_t count, Produce&& produce, Consume&& consume) {
  parallel_ordered(count, produce, consume, [](std::size_t) { return true; });
}

/// Independent iterations; each may write only what belongs to its own index.
template <class Body>
void parallel_for(std::size_t count, Body&& body) {
  tbb::parallel_for(std::size_t{0}, count, body);
}

}  // namespace pharos
