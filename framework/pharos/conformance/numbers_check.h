#pragma once

#include <pharos/conformance/check.h>
#include <pharos/conformance/guide_stage.h>

namespace pharos::conformance {

/// Tests the random numbers for which the proposals of a guide ask, at vertices of a room. They may
/// ask for numbers of guides and of the BSDF only. They must not ask for both `guide_direction` and
/// `bsdf_direction` of a branch, because samplers may return the same points for both.
void check_numbers(const GuidingFrame& frame, const Scene& scene, std::uint64_t seed,
                   Transport transport, Check& check);

}  // namespace pharos::conformance
