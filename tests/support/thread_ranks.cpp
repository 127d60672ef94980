#include "thread_ranks.h"

#include <barrier>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>

#include <pharos/rendering/rank_helper.h>
#include <pharos/rendering/rank_leader.h>

#include "renders.h"

namespace pharos::testing {
namespace {

/// The messages between all ranks.
struct PostOffice {
  explicit PostOffice(int ranks) : boxes(static_cast<std::size_t>(ranks)), all(ranks) {}

  std::mutex mutex;
  std::vector<std::deque<Ranks::Message>> boxes;  ///< by receiver
  std::barrier<> all;
  std::string common;  ///< what is broadcast
};

class ThreadRanks final : public Ranks {
 public:
  ThreadRanks(PostOffice& office, int rank) : office_(office), rank_(rank) {}

  int rank() const override { return rank_; }
  int count() const override { return static_cast<int>(office_.boxes.size()); }
  int count_on_cores() const override { return count(); }
  void send(int to, std::string bytes) override {
    const std::lock_guard lock(office_.mutex);
    office_.boxes[static_cast<std::size_t>(to)].push_back({rank_, std::move(bytes)});
  }
  std::optional<Message> receive() override {
    const std::lock_guard lock(office_.mutex);
    std::deque<Message>& box = office_.boxes[static_cast<std::size_t>(rank_)];
    if (box.empty()) return std::nullopt;
    Message message = std::move(box.front());
    box.pop_front();
    return message;
  }
  void broadcast(std::string& bytes) override {
    if (rank_ == 0) office_.common = bytes;
    office_.all.arrive_and_wait();
    bytes = office_.common;
    office_.all.arrive_and_wait();
  }

 private:
  PostOffice& office_;
  int rank_;
};

}  // namespace

void as_ranks(int count, const std::function<void(Ranks&)>& work) {
  PostOffice office(count);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank) {
    threads.emplace_back([&, rank] {
      ThreadRanks ranks(office, rank);
      work(ranks);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

RenderResult render_on_ranks(const std::string& yaml, int ranks, int threads, RenderControl control,
                             const std::string& state) {
  const LoadedConfig loaded = config_from(yaml);
  RenderResult result;
  std::exception_ptr error;
  as_ranks(ranks, [&](Ranks& own) {
    tbb::task_arena(threads).execute([&] {
      if (own.rank() > 0) return RenderJob(loaded.config).help(own, "");
      try {
        control.ranks = &own;
        result = RenderJob(loaded.config).run(control, state);
      } catch (...) {
        error = std::current_exception();
      }
      dismiss_helpers(own);
    });
  });
  if (error) std::rethrow_exception(error);
  return result;
}

}  // namespace pharos::testing
