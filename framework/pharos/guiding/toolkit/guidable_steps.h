#pragma once

#include <algorithm>
#include <vector>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// A step of a recorded path from the sensor that a guide could have sampled, and what came of it.
struct GuidableStep {
  const RecordedVertex& from;
  const RecordedVertex& to;
  std::uint32_t number;  ///< of `from` within the path
  /// Radiance that came along the step; in a medium times the transmittance, over the density of
  /// the step's length. Zero where nothing came.
  Rgb radiance;
  Rgb reflected;  ///< what the step adds to the radiance that leaves `from`, f/p included
  float pdf = 0;  ///< of the direction: scattering and guide together [1/sr]
};

/// Calls `visit(step)` for the steps that met something, those that found no light there included,
/// each once. (Steps that a surface scatters nothing into end unseen.) With Russian roulette
/// radiances lack its probability. `incident` is scratch memory, kept from call to call.
template <class Visit>
void for_each_guidable_step(const PathView& path, std::vector<Rgb>& incident, Visit&& visit) {
  if (path.transport != Transport::radiance) return;
  estimate_incident_radiance(path, incident);
  for (std::uint32_t i = 1; i < path.vertices.size(); ++i) {
    const RecordedVertex& from = path.vertices[i];
    if (!from.guidable || is_discrete(from.event)) continue;
    // The first vertex that the step led to: where the path branches there, others are its copies.
    const auto to = std::find_if(path.vertices.begin() + i + 1, path.vertices.end(),
                                 [&](const RecordedVertex& v) { return v.parent == i; });
    if (to == path.vertices.end()) continue;
    // Of the density the direction's part; the medium's is as it is.
    const float medium = from.medium_density;
    visit(GuidableStep{.from = from,
                       .to = *to,
                       .number = i,
                       .radiance = from.transmittance * incident[i] / medium,
                       .reflected = from.local_weight * incident[i],
                       .pdf = from.pdf() / medium});
  }
}

}  // namespace pharos
