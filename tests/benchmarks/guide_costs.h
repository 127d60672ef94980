#pragma once

#include <cstdint>
#include <vector>

#include "guide_queries.h"

namespace pharos::bench {

/// What a guide takes on one thread, in processor time.
struct GuideCosts {
  double query_ns = 0;            ///< BoundGuider::query()
  double sample_ns = 0;           ///< GuidingDistribution::propose(), its random numbers included
  double pdf_ns = 0;              ///< GuidingDistribution::density()
  std::uint64_t allocations = 0;  ///< from the heap, in all of them together
};

/// Asks all queries once, a few vertices at a time, so that what a query has made is as near as it
/// is in a render. The arena's own blocks are there beforehand.
GuideCosts measure_costs(const BoundGuider& guider, const std::vector<GuideQuery>& queries);

}  // namespace pharos::bench
