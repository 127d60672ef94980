#include <algorithm>
#include <deque>
#include <memory>
#include <mpi.h>
#include <optional>
#include <sched.h>
#include <string>
#include <utility>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/core/export.h>
#include <pharos/rendering/mpi_ranks.h>

namespace pharos {
namespace {

/// MPI counts bytes by an int, so a long message is sent in parts of this size.
constexpr std::size_t kLongestPart = std::size_t{1} << 30;
constexpr int kLastPart = 0, kMoreFollows = 1;  // tags

/// The ranks of MPI_COMM_WORLD. MPI itself ends all processes when a call fails.
class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) {
      throw RunError("this MPI library cannot be used by several threads");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    count_on_cores_ = processes_on_own_cores();
    incoming_.resize(static_cast<std::size_t>(count_));
  }
  ~MpiRanks() override {
    for (Part& part : outgoing_) MPI_Wait(&part.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  int count_on_cores() const override { return count_on_cores_; }

  void send(int to, std::string bytes) override {
    const auto message = std::make_shared<const std::string>(std::move(bytes));
    std::size_t begin = 0;
    do {
      const std::size_t size = std::min(message->size() - begin, kLongestPart);
      const bool is_last = begin + size == message->size();
      Part& part = outgoing_.emplace_back(Part{message, MPI_REQUEST_NULL});
      MPI_Isend(message->data() + begin, static_cast<int>(size), MPI_BYTE, to,
                is_last ? kLastPart : kMoreFollows, MPI_COMM_WORLD, &part.request);
      begin += size;
    } while (begin < message->size());
  }

  std::optional<Message> receive() override {
    forget_sent_parts();
    for (;;) {
      int has_arrived = 0;
      MPI_Message part = MPI_MESSAGE_NULL;
      MPI_Status status;
      MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_arrived, &part, &status);
      if (has_arrived == 0) return std::nullopt;
      int size = 0;
      MPI_Get_count(&status, MPI_BYTE, &size);
      std::string& bytes = incoming_[static_cast<std::size_t>(status.MPI_SOURCE)];
      const std::size_t begin = bytes.size();
      bytes.resize(begin + static_cast<std::size_t>(size));
      MPI_Mrecv(bytes.data() + begin, size, MPI_BYTE, &part, &status);
      if (status.MPI_TAG == kLastPart) return Message{status.MPI_SOURCE, std::exchange(bytes, {})};
    }
  }

  void broadcast(std::string& bytes) override {
    auto count = static_cast<unsigned long long>(bytes.size());
    MPI_Bcast(&count, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
    bytes.resize(count);
    for (std::size_t begin = 0; begin < bytes.size(); begin += kLongestPart) {
      const std::size_t size = std::min(bytes.size() - begin, kLongestPart);
      MPI_Bcast(bytes.data() + begin, static_cast<int>(size), MPI_BYTE, 0, MPI_COMM_WORLD);
    }
  }

 private:
  /// A part of a message that is on its way.
  struct Part {
    std::shared_ptr<const std::string> message;
    MPI_Request request;
  };

  /// Returns how many processes on this machine may use a core that this one may use.
  static int processes_on_own_cores() {
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    int count = 1;
    MPI_Comm_size(here, &count);
    cpu_set_t own;
    CPU_ZERO(&own);
    sched_getaffinity(0, sizeof own, &own);
    std::vector<cpu_set_t> all(static_cast<std::size_t>(count));
    MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, here);
    MPI_Comm_free(&here);
    return static_cast<int>(std::count_if(all.begin(), all.end(), [&](cpu_set_t other) {
      CPU_AND(&other, &other, &own);
      return CPU_COUNT(&other) > 0;
    }));
  }

  void forget_sent_parts() {
    while (!outgoing_.empty()) {
      int is_sent = 0;
      MPI_Test(&outgoing_.front().request, &is_sent, MPI_STATUS_IGNORE);
      if (is_sent == 0) return;
      outgoing_.pop_front();
    }
  }

  int rank_ = 0, count_ = 1, count_on_cores_ = 1;
  std::deque<Part> outgoing_;          ///< requests do not move in memory
  std::vector<std::string> incoming_;  ///< the parts so far, by rank
};

}  // namespace
}  // namespace pharos

extern "C" PHAROS_EXPORT pharos::Ranks* pharos_mpi_ranks() {
  return new pharos::MpiRanks;
}
