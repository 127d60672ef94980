#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>

#include <pharos/rendering/rank_helper.h>
#include <pharos/rendering/rank_messages.h>

namespace pharos {
namespace {

using namespace messages;

/// A queue between threads.
template <class T>
class Channel {
 public:
  void push(T value) {
    const std::lock_guard lock(mutex_);
    values_.push_back(std::move(value));
    changed_.notify_one();
  }
  /// Returns the oldest value. Returns none after close().
  std::optional<T> wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !values_.empty() || is_closed_; });
    return take();
  }
  std::optional<T> poll() {
    const std::lock_guard lock(mutex_);
    return take();
  }
  /// Drops all values. wait() returns none from now on.
  void close() {
    const std::lock_guard lock(mutex_);
    values_.clear();
    is_closed_ = true;
    changed_.notify_all();
  }

 private:
  std::optional<T> take() {
    if (values_.empty()) return std::nullopt;
    T value = std::move(values_.front());
    values_.pop_front();
    return value;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> values_;
  bool is_closed_ = false;
};

std::string reason_of(std::exception_ptr error) {
  try {
    std::rethrow_exception(std::move(error));
  } catch (const std::exception& known) {
    return known.what();
  } catch (...) {
    return "unknown error";
  }
}

std::string failure(std::string reason) {
  return write(Kind::failure, reason);
}

class Helper {
 public:
  Helper(Ranks& ranks, const HelperWork& work) : ranks_(ranks), work_(work) {}
  ~Helper() { units_.close(); }  // then the threads end

  void run(const std::string& render_key) {
    Ready ready{static_cast<std::uint32_t>(tbb::this_task_arena::max_concurrency()), render_key};
    ranks_.send(0, write(Kind::ready, ready));
    for (std::uint32_t i = 0; i < ready.threads; ++i) threads_.emplace_back([this] { render(); });
    exchange_messages();
    units_.close();
    threads_.clear();
    ranks_.send(0, write(Kind::left));
  }

 private:
  /// Renders units one after another.
  void render() {
    while (std::optional<Unit> unit = units_.wait()) {
      try {
        WorkResult result = work_.render(unit->unit, unit->is_recorded);
        outbox_.push(write(Kind::result, unit->number, result));
      } catch (...) {
        outbox_.push(failure(reason_of(std::current_exception())));
      }
    }
  }

  void exchange_messages() {
    for (Pauses pauses;; pauses.rest()) {
      while (std::optional<std::string> message = outbox_.poll()) {
        ranks_.send(0, std::move(*message));
        pauses.wake();
      }
      while (std::optional<Ranks::Message> message = ranks_.receive()) {
        Reader reader(std::move(message->bytes));
        if (reader.kind() == Kind::end) return;
        take(reader);
        pauses.wake();
      }
    }
  }

  void take(Reader& message) {
    if (message.kind() == Kind::unit) return units_.push(message.next<Unit>());
    const auto trains = message.next<bool>();
    std::string frozen;
    ranks_.broadcast(frozen);
    try {
      work_.begin_iteration(trains, frozen);
    } catch (...) {
      ranks_.send(0, failure(reason_of(std::current_exception())));
    }
  }

  Ranks& ranks_;
  const HelperWork& work_;
  Channel<Unit> units_;
  Channel<std::string> outbox_;
  std::vector<std::jthread> threads_;
};

}  // namespace

void help(Ranks& ranks, const std::string& render, const HelperWork& work) {
  Helper(ranks, work).run(render);
}

void refuse_to_help(Ranks& ranks, const std::string& reason) {
  ranks.send(0, failure(reason));
  for (bool is_over = false; !is_over;) {
    std::optional<Ranks::Message> message = wait_for_message(ranks, [] { return true; });
    is_over = Reader(std::move(message->bytes)).kind() == Kind::end;
  }
  ranks.send(0, write(Kind::left));
}

}  // namespace pharos
