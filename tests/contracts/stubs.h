#pragma once

#include <pharos/config/registry.h>

namespace pharos::stubs {

/// Each function registers the plugins of one stub.
void register_direction(Registry& registry);        // (a) and the regions of (e)
void register_segments(Registry& registry);         // (b)
void register_vertices(Registry& registry);         // (c)
void register_medium(Registry& registry);           // the medium in which (c) samples distances
void register_camera(Registry& registry);           // (d)
void register_mixing(Registry& registry);           // (e)
void register_probing_sampler(Registry& registry);  // (f)
void register_mixture(Registry& registry);          // (g), the model
void register_mixture_guiders(Registry& registry);  // (g), the guiders, in another module
void register_memory(Registry& registry);           // (h)
void register_termination(Registry& registry);      // (i)

}  // namespace pharos::stubs
