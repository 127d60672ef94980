#pragma once

#include <cstdint>
#include <vector>

#include "guide_queries.h"

namespace pharos::bench {

/// Costs of a guide on one thread, in processor time.
struct GuideCosts {
  double query_ns = 0;            ///< GuidingModel::place() and BoundGuider::query()
  double sample_ns = 0;           ///< GuidingDistribution::propose(), its random numbers included
  double pdf_ns = 0;              ///< GuidingDistribution::density()
  std::uint64_t allocations = 0;  ///< heap allocations of all three together
};

/// Measures all queries once, a few vertices at a time, so that the results of a query are as close
/// in the caches as in a render. The arena's own blocks are allocated before.
GuideCosts measure_costs(const BoundGuider& guider, const std::vector<GuideQuery>& queries);

}  // namespace pharos::bench
