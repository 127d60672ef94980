#include "guide_costs.h"

#include <algorithm>
#include <span>

#include <pharos/conformance/guided.h>

#include "allocation_count.h"
#include "thread_time.h"

namespace pharos::bench {
namespace {

/// Number of vertices that are measured together. It is small enough that the results of queries
/// stay in the nearest cache.
constexpr std::size_t kBatch = 8;

/// Returns the time of thread_ns() itself [ns].
double clock_ns() {
  constexpr int kTimes = 10'000;
  const double start = thread_ns();
  for (int i = 1; i < kTimes; ++i) thread_ns();
  return (thread_ns() - start) / kTimes;
}

/// Prevents the compiler from optimizing results away.
volatile float sink;

class CostMeter {
 public:
  explicit CostMeter(const BoundGuider& guider) : guider_(guider) {
    streams_.reserve(kBatch);
    queries_.reserve(kBatch);
    distributions_.reserve(kBatch);
  }

  /// Measures a batch and adds its times [ns].
  void add(std::span<const GuideQuery> batch, std::uint64_t first) {
    prepare(batch, first);
    float sum = 0;
    const double start = thread_ns();
    for (GuidingQuery& query : queries_) distributions_.push_back(ask(query));
    const double queried = thread_ns();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const VertexStream stream(streams_[i], queries_[i].bounce);
      if (const auto proposal = distributions_[i]->propose(stream)) sum += proposal->direction.x;
    }
    const double sampled = thread_ns();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      sum += distributions_[i]->density(batch[i].guided);
      sum += distributions_[i]->density(batch[i].scattered);
    }
    const double end = thread_ns();
    sink = sum;
    costs_.query_ns += queried - start - clock_ns_;
    costs_.sample_ns += sampled - queried - clock_ns_;
    costs_.pdf_ns += end - sampled - clock_ns_;
  }

  GuideCosts take() { return std::exchange(costs_, {}); }

 private:
  /// Queries each vertex once before measuring, because in a render the vertices and their surfaces
  /// are already in the caches.
  void prepare(std::span<const GuideQuery> batch, std::uint64_t first) {
    distributions_.clear();
    streams_.clear();
    queries_.clear();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      streams_.emplace_back(numbers_, PathKey{.seed = 3, .index = first + i});
      queries_.push_back(batch[i].vertex->query());
      arena_.reset();
      ask(queries_.back());
    }
    arena_.reset();
  }

  const GuidingDistribution* ask(GuidingQuery& query) {
    query.region = guider_.model().place(query.current).region;
    return guider_.query(query, arena_);
  }

  const BoundGuider& guider_;
  conformance::KeyedSampler numbers_;
  const double clock_ns_ = clock_ns();
  Arena arena_;
  std::vector<SampleStream> streams_;
  std::vector<GuidingQuery> queries_;
  std::vector<const GuidingDistribution*> distributions_;
  GuideCosts costs_;
};

}  // namespace

GuideCosts measure_costs(const BoundGuider& guider, const std::vector<GuideQuery>& queries) {
  CostMeter meter(guider);
  const auto ask_all = [&] {
    for (std::size_t i = 0; i < queries.size(); i += kBatch) {
      const std::size_t n = std::min(kBatch, queries.size() - i);
      meter.add({queries.data() + i, n}, i);
    }
  };
  ask_all();  // warms the caches and allocates the arena's blocks
  meter.take();
  const std::uint64_t before = testing::allocation_count();
  ask_all();
  GuideCosts costs = meter.take();
  costs.allocations = testing::allocation_count() - before;
  const auto count = static_cast<double>(queries.size());
  costs.query_ns /= count;
  costs.sample_ns /= count;
  costs.pdf_ns /= 2 * count;
  return costs;
}

}  // namespace pharos::bench
