#pragma once

#include <memory>
#include <vector>

#include <pharos/conformance/guide_stage.h>
#include <pharos/guiding/pipeline/guiding.h>

namespace pharos::bench {

/// A vertex where a guide is asked, and the two ends whose densities a path needs there.
struct GuideQuery {
  std::unique_ptr<const conformance::StageVertex> vertex;
  ResolvedVertex guided;     ///< drawn from the guide
  ResolvedVertex scattered;  ///< drawn from the BSDF
};

/// Queries at the smooth surface points of paths from the sensor, in the order in which a render
/// meets them: each path goes on by the guide or by the BSDF, whichever a coin says. Vertices where
/// either draw leads nowhere are left out. For scenes without media. Throws RunError when paths
/// meet too few such vertices.
std::vector<GuideQuery> guide_queries(const Scene& scene, const GuidingFrame& guiding,
                                      std::size_t count);

}  // namespace pharos::bench
