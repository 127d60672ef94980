#pragma once

#include <pharos/conformance/check.h>
#include <pharos/conformance/guide_stage.h>

namespace pharos::conformance {

/// Tests which random numbers the proposals of a guide ask for, at vertices of a room: those of
/// guides and of the BSDF alone, because samplers may derive others from `mix_choice`; and never
/// both `guide_direction` and `bsdf_direction` of a branch, which may be the same points.
void check_numbers(const GuidingFrame& frame, const Scene& scene, std::uint64_t seed,
                   Transport transport, Check& check);

}  // namespace pharos::conformance
