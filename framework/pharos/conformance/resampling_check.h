#pragma once

#include <pharos/conformance/check.h>
#include <pharos/conformance/guide_stage.h>

namespace pharos::conformance {

/// Tests what resampling needs from a guide and its model, at vertices of a room: the radiance
/// around the vertex has the mean 1 over all directions, and resampled steps estimate the same
/// integrals as unguided steps. There is no test of densities, because resampled steps have none in
/// closed form.
void check_resampling(const Guider& guider, const std::shared_ptr<const GuidingModel>& model,
                      const Scene& scene, std::uint64_t seed, Check& check);

}  // namespace pharos::conformance
