#pragma once

#include <cstddef>
#include <vector>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Calls `visit(path, vertex, incident)` for every step from a vertex where a guide took part, on
/// paths from the sensor. `incident` is the radiance that the path estimates along the step.
/// `scratch` keeps its memory from call to call.
template <class Visit>
void for_each_mixed_step(const PathLog& log, std::vector<Rgb>& scratch, Visit&& visit) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    if (path.transport != Transport::radiance) continue;
    estimate_incident_radiance(path, scratch);
    for (std::size_t k = 0; k < path.vertices.size(); ++k) {
      const RecordedVertex& vertex = path.vertices[k];
      if (vertex.mixing_key != kNoMixing) visit(path, vertex, scratch[k]);
    }
  }
}

}  // namespace pharos
