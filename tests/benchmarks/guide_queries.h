#pragma once

#include <memory>
#include <vector>

#include <pharos/conformance/guide_stage.h>
#include <pharos/guiding/pipeline/guiding_frame.h>

namespace pharos::bench {

/// A vertex at which a guide is asked, and the two next vertices whose densities a path needs
/// there.
struct GuideQuery {
  std::unique_ptr<const conformance::StageVertex> vertex;
  ResolvedVertex guided;     ///< sampled from the guide
  ResolvedVertex scattered;  ///< sampled from the BSDF
};

/// Returns queries at the smooth surface points of paths from the sensor, in the order in which a
/// render visits them. A random choice decides whether a path continues by the guide or by the
/// BSDF. Vertices at which either sample is invalid are omitted. Only for scenes without media.
/// Throws RunError if paths meet too few such vertices.
std::vector<GuideQuery> guide_queries(const Scene& scene, const GuidingFrame& guiding,
                                      std::size_t count);

}  // namespace pharos::bench
