#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <pharos/config/values.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Whether the results of a step contain the light that the step hits.
enum class LightHits {
  weighted,  ///< yes, times its MIS weight
  left_out   ///< no. Light samples find such light, so that a guide need not
};

/// A step of a recorded path from the sensor that a guide could have sampled, together with its
/// results.
struct GuidableStep {
  const RecordedVertex& from;
  const RecordedVertex& to;
  std::uint32_t number;  ///< index of `from` within the path
  /// Estimate of the radiance that arrives along the step, times RecordedVertex::continuation. In a
  /// medium it is also multiplied by the transmittance and divided by the medium's factor in the
  /// density of the step. It is zero if no light arrived.
  Rgb radiance;
  Rgb reflected;  ///< contribution of the step to the radiance that leaves `from`, including f/p
  float pdf = 0;  ///< density of the direction over all techniques together [1/sr]
};

/// Calls `visit(step)` once for each guidable step that reached a vertex, whether or not it found
/// light. Steps into directions into which a surface scatters nothing are left out. `hits` states
/// whether the results contain what the next vertex emits. `incident` is scratch memory that the
/// caller keeps from call to call.
template <class Visit>
void for_each_guidable_step(const PathView& path, LightHits hits, std::vector<Rgb>& incident,
                            Visit&& visit) {
  if (path.transport != Transport::radiance) return;
  estimate_incident_radiance(path, incident);
  for (std::uint32_t i = 1; i < path.vertices.size(); ++i) {
    const RecordedVertex& from = path.vertices[i];
    if (!from.guidable || is_discrete(from.event)) continue;
    if (from.next == kNoVertex) continue;
    const RecordedVertex& to = path.vertices[from.next];
    const Rgb arriving =
        hits == LightHits::weighted ? incident[i] : max(incident[i] - to.emission, Rgb());
    // The density is the product of a factor for the direction and a factor for the medium.
    const float medium = from.medium_density;
    visit(GuidableStep{.from = from,
                       .to = to,
                       .number = i,
                       .radiance = from.continuation * from.transmittance * arriving / medium,
                       .reflected = from.local_weight * arriving,
                       .pdf = from.pdf / medium});
  }
}

/// The same with the light that steps hit.
template <class Visit>
void for_each_guidable_step(const PathView& path, std::vector<Rgb>& incident, Visit&& visit) {
  for_each_guidable_step(path, LightHits::weighted, incident, std::forward<Visit>(visit));
}

template <>
struct EnumNames<LightHits> {
  static constexpr auto names = std::to_array<EnumName<LightHits>>(
      {{"weighted", LightHits::weighted}, {"left_out", LightHits::left_out}});
};

}  // namespace pharos
