#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <pharos/core/error.h>
#include <pharos/rendering/rank_leader.h>
#include <pharos/rendering/rank_messages.h>

namespace pharos {
namespace {

using namespace messages;

/// How long a thread without a unit waits before it looks for one.
constexpr std::chrono::milliseconds kIdle{1};

[[noreturn]] void throw_failure(int rank, Reader& message) {
  throw RunError(fmt::format("rank {}: {}", rank, message.next<std::string>()));
}

}  // namespace

/// A pass while it is rendered. Units are numbered in order. At any time, those below `merged_` are
/// part of the film, and those below `next_` have been handed out.
class RankLeader::Pass {
 public:
  Pass(RankLeader& leader, const UnitPass& pass)
      : leader_(leader),
        pass_(pass),
        slots_(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())) {
    for (const Helper& helper : leader.helpers_) threads_elsewhere_ += helper.threads;
  }

  void run() {
    {
      const std::jthread exchange([this](const std::stop_token& end) { exchange_messages(end); });
      render_here();
    }
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// Hands out the next unit. Returns none if there is none now: results that wait for an earlier
  /// one take memory, so only a few units may be ahead of the film.
  std::optional<std::size_t> take() {
    const std::lock_guard lock(mutex_);
    if (must_stop() || next_ == pass_.count || next_ >= merged_ + window()) return std::nullopt;
    return next_++;
  }

  /// Whether the pass ends early. The caller holds the mutex.
  bool must_stop() {
    if (error_ || !pass_.keeps_going()) is_stopped_ = true;
    return is_stopped_;
  }

  /// Returns how many units may be ahead of the film. The caller holds the mutex.
  std::size_t window() const {
    // The first results tell how large they are.
    const std::size_t bytes = largest_result(next_), ranks = leader_.helpers_.size();
    const std::size_t elsewhere =
        bytes == 0 ? ranks : std::max(ranks, leader_.waiting_bytes_ / bytes);
    return 4 * slots_ + elsewhere;
  }
  std::size_t& largest_result(std::size_t unit) const {
    return leader_.largest_result_[pass_.is_recorded(unit) ? 1 : 0];
  }

  void put(std::size_t i, WorkResult result) {
    const std::lock_guard lock(mutex_);
    finished_.emplace(i, std::move(result));
    has_arrived_.notify_one();
  }

  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
    is_stopped_ = true;
    has_arrived_.notify_one();
  }

  // The following functions run within the arena.

  void render_here() {
    tbb::task_group group;
    for (;;) {
      spawn(group);
      group.wait();
      merge_finished();
      std::unique_lock lock(mutex_);
      if (must_stop() || merged_ == pass_.count) return;
      has_arrived_.wait_for(lock, kIdle, [&] { return is_next_finished(); });
    }
  }

  /// Begins units until every thread has one.
  void spawn(tbb::task_group& group) {
    while (active_.fetch_add(1) < slots_) {
      const std::optional<std::size_t> i = take();
      if (!i) break;
      group.run([this, &group, i = *i] {
        render(i);
        --active_;
        spawn(group);
      });
    }
    --active_;
  }

  void render(std::size_t i) {
    try {
      put(i, pass_.render(i));
      merge_finished();
    } catch (...) {
      fail(std::current_exception());
    }
  }

  /// Merges all results whose turn it is, unless another thread does so.
  void merge_finished() {
    while (is_turn() && !is_merging_.exchange(true)) {
      while (std::optional<WorkResult> result = take_finished()) merge(*result);
      is_merging_ = false;
      // A result that came after the last look must not be left to itself.
    }
  }

  void merge(WorkResult& result) {
    try {
      pass_.merge(merged_, result);
    } catch (...) {
      fail(std::current_exception());
    }
    const std::lock_guard lock(mutex_);
    ++merged_;
  }

  std::optional<WorkResult> take_finished() {
    const std::lock_guard lock(mutex_);
    if (!is_next_finished()) return std::nullopt;
    return std::move(finished_.extract(finished_.begin()).mapped());
  }

  bool is_turn() {
    const std::lock_guard lock(mutex_);
    return is_next_finished();
  }
  bool is_next_finished() const {
    return !error_ && !finished_.empty() && finished_.begin()->first == merged_;
  }

  // The following functions run on the thread that exchanges messages.

  void exchange_messages(const std::stop_token& end) {
    try {
      for (Pauses pauses; !end.stop_requested(); pauses.rest()) {
        const bool has_received = receive_results(), has_sent = send_units();
        if (has_received || has_sent) pauses.wake();
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }

  bool receive_results() {
    bool has_received = false;
    while (std::optional<Ranks::Message> message = leader_.ranks_.receive()) {
      has_received = true;
      const std::size_t bytes = message->bytes.size();
      Reader reader(std::move(message->bytes));
      if (reader.kind() != Kind::result) throw_failure(message->from, reader);
      const auto number = static_cast<std::size_t>(reader.next<std::uint64_t>());
      WorkResult result = pass_.blank(number);
      reader.read(result);
      --leader_.helpers_[message->from].units;
      put(number, std::move(result));
      const std::lock_guard lock(mutex_);
      std::size_t& largest = largest_result(number);
      largest = std::max(largest, bytes);
    }
    return has_received;
  }

  bool send_units() {
    bool has_sent = false;
    for (int rank = 1; rank < leader_.ranks_.count(); ++rank) {
      Helper& helper = leader_.helpers_[rank];
      while (may_have_more(helper)) {
        const std::optional<std::size_t> i = take();
        if (!i) return has_sent;
        Unit unit{*i, pass_.unit(*i), pass_.is_recorded(*i)};
        leader_.ranks_.send(rank, write(Kind::unit, unit));
        ++helper.units;
        has_sent = true;
      }
    }
    return has_sent;
  }

  /// While the threads of a rank render, one more unit waits there, except at the end of a pass,
  /// when other threads would have to wait for it.
  bool may_have_more(const Helper& helper) {
    if (helper.units < helper.threads) return true;
    const std::lock_guard lock(mutex_);
    return helper.units == helper.threads && pass_.count - next_ > slots_ + threads_elsewhere_;
  }

  RankLeader& leader_;
  const UnitPass& pass_;
  const std::size_t slots_;             ///< threads that render here
  std::size_t threads_elsewhere_ = 0;   ///< that render on other ranks
  std::atomic<std::size_t> active_{0};  ///< units that are rendered here
  std::atomic<bool> is_merging_{false};

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable has_arrived_;
  std::size_t next_ = 0, merged_ = 0;
  std::map<std::size_t, WorkResult> finished_;  ///< results that are not merged yet
  std::exception_ptr error_;
  bool is_stopped_ = false;
};

RankLeader::RankLeader(Ranks& ranks, const std::string& render,
                       const std::function<bool()>& keeps_going, std::size_t waiting_bytes)
    : ranks_(ranks),
      waiting_bytes_(waiting_bytes),
      helpers_(static_cast<std::size_t>(ranks.count())) {
  for (int waiting = ranks.count() - 1; waiting > 0; --waiting) {
    std::optional<Ranks::Message> message = wait_for_message(ranks, keeps_going);
    if (!message) return;
    Reader reader(std::move(message->bytes));
    if (reader.kind() != Kind::ready) throw_failure(message->from, reader);
    const auto ready = reader.next<Ready>();
    if (ready.render != render) {
      throw RunError(fmt::format(
          "rank {} has another config, another file that it names, or another build of Pharos",
          message->from));
    }
    helpers_[static_cast<std::size_t>(message->from)].threads = ready.threads;
  }
}

void RankLeader::begin_iteration(bool trains, const std::function<std::string()>& save_frozen) {
  // Saved first: if this fails, no rank must be waiting for the broadcast.
  std::string frozen = save_frozen();
  const std::string message = write(Kind::iteration, trains);
  for (int rank = 1; rank < ranks_.count(); ++rank) ranks_.send(rank, message);
  ranks_.broadcast(frozen);
}

void RankLeader::run(const UnitPass& pass) {
  Pass(*this, pass).run();
}

void RankLeader::on_idle_cores(const std::function<void()>& work) {
  const int threads = tbb::this_task_arena::max_concurrency();
  tbb::task_arena(threads * ranks_.count_on_cores()).execute(work);
}

void dismiss_helpers(Ranks& ranks) {
  for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, write(Kind::end));
  for (int waiting = ranks.count() - 1; waiting > 0;) {
    std::optional<Ranks::Message> message = wait_for_message(ranks, [] { return true; });
    if (Reader(std::move(message->bytes)).kind() == Kind::left) --waiting;
  }
}

}  // namespace pharos
