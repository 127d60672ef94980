#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>

namespace pharos::gaussians {

void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples) {
  if (path.transport != Transport::radiance) return;
  estimate_incident_radiance(path, incident);
  for (std::size_t i = 1; i < path.vertices.size(); ++i) {
    const RecordedVertex& end = path.vertices[i];
    if (end.parent == kNoVertex || end.parent == 0) continue;
    const RecordedVertex& vertex = path.vertices[end.parent];
    if (!vertex.guidable || is_discrete(vertex.event)) continue;
    // Of the density the direction's part; the medium's is as it is.
    const float medium = vertex.medium_density;
    const float pdf = std::max(vertex.pdf() / medium, rule.least_pdf);
    const float weight = mean(vertex.transmittance * incident[end.parent]) / (pdf * medium);
    if (!(weight >= 0) || !std::isfinite(weight) || !std::isfinite(pdf)) continue;
    const bool escapes = end.kind == VertexKind::environment;
    const Point3 target =
        escapes ? vertex.position + rule.environment_distance * vertex.direction : end.position;
    // So close that rounding leaves no direction.
    if (!(length_squared(target - vertex.position) > 0)) continue;
    samples.push_back({.origin = vertex.position, .target = target, .weight = weight, .pdf = pdf});
  }
}

void save_sample(const Sample& sample, std::ostream& out) {
  for (const Point3 p : {sample.origin, sample.target}) {
    for (int axis = 0; axis < 3; ++axis) save_number(out, p[axis]);
  }
  save_number(out, sample.weight);
  save_number(out, sample.pdf);
}

Sample load_sample(std::istream& in) {
  Sample sample;
  for (Point3* p : {&sample.origin, &sample.target}) {
    for (int axis = 0; axis < 3; ++axis) (*p)[axis] = load_finite<float>(in);
  }
  sample.weight = load_finite<float>(in);
  sample.pdf = load_finite<float>(in);
  const bool is_sound =
      sample.weight >= 0 && sample.pdf > 0 && length_squared(sample.target - sample.origin) > 0;
  if (!is_sound) throw InputError("a sample of the Gaussians is damaged");
  return sample;
}

}  // namespace pharos::gaussians
