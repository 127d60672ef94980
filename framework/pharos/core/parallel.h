#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace pharos {

/// Runs `produce(i)` for i = 0, 1, … concurrently, and `consume(i, result)` in order of i, one call
/// at a time. The value that consume() accumulates is therefore the same for any number of threads.
/// At most about four results per thread wait at any time, so memory stays bounded. The loop ends
/// at `count`, or earlier at the first i for which `keep_going(i)` is false; all smaller i are
/// still consumed. The first exception in order of i ends the loop and is rethrown.
template <class Produce, class Consume, class KeepGoing>
void parallel_ordered(std::size_t count, Produce&& produce, Consume&& consume,
                      KeepGoing&& keep_going) {
  using Result = decltype(produce(std::size_t{0}));
  struct Item {
    std::size_t index;
    std::optional<Result> result;
    std::exception_ptr error;
  };
  using ItemPtr = std::shared_ptr<Item>;
  const auto tokens = 4 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::size_t next = 0;
  std::atomic<bool> failed{false};
  std::exception_ptr first_error;  // first in order of i
  const auto number = [&](tbb::flow_control& flow) -> std::size_t {
    if (next < count && !failed && keep_going(next)) return next++;
    flow.stop();
    return 0;
  };
  // Exceptions must not leave the pipeline: it would drop the items that it is still processing.
  const auto work = [&](std::size_t i) {
    auto item = std::make_shared<Item>(Item{i, std::nullopt, nullptr});
    try {
      item->result.emplace(produce(i));
    } catch (...) {
      item->error = std::current_exception();
      failed = true;
    }
    return item;
  };
  const auto fold = [&](const ItemPtr& item) {
    if (first_error) return;
    if (item->error) {
      first_error = item->error;
      return;
    }
    try {
      consume(item->index, *item->result);
    } catch (...) {
      first_error = std::current_exception();
      failed = true;
    }
  };
  tbb::parallel_pipeline(
      tokens, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, number) &
                  tbb::make_filter<std::size_t, ItemPtr>(tbb::filter_mode::parallel, work) &
                  tbb::make_filter<ItemPtr, void>(tbb::filter_mode::serial_in_order, fold));
  if (first_error) std::rethrow_exception(first_error);
}

/// The same without an early end.
template <class Produce, class Consume>
void parallel_ordered(std::size_t count, Produce&& produce, Consume&& consume) {
  parallel_ordered(count, produce, consume, [](std::size_t) { return true; });
}

/// Runs `body(i)` for each i below `count` concurrently. Each call may write only data that belongs
/// to its own index.
template <class Body>
void parallel_for(std::size_t count, Body&& body) {
  tbb::parallel_for(std::size_t{0}, count, body);
}

}  // namespace pharos
