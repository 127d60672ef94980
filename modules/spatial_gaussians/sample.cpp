#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>

namespace pharos::gaussians {

void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples) {
  estimate_incident_radiance(path, incident);
  for (std::size_t i = 1; i < path.vertices.size(); ++i) {
    const RecordedVertex& end = path.vertices[i];
    if (end.parent == kNoVertex || end.parent == 0) continue;
    const RecordedVertex& vertex = path.vertices[end.parent];
    if (!vertex.guidable || is_discrete(vertex.event)) continue;
    const bool directional = vertex.measure == Measure::solid_angle;
    const float pdf = directional ? std::max(vertex.pdf(), rule.least_pdf) : 0.0f;
    const Rgb& light = incident[end.parent];
    const float weight = directional ? mean(light) / pdf : mean(vertex.local_weight * light);
    if (!(weight >= 0) || !std::isfinite(weight)) continue;
    const bool escapes = end.kind == VertexKind::environment;
    samples.push_back(
        {.origin = vertex.position,
         .target = escapes ? vertex.position + rule.environment_distance * vertex.direction
                           : end.position,
         .weight = weight,
         .pdf = pdf});
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
  if (sample.weight < 0 || sample.pdf < 0) throw InputError("a sample of the Gaussians is damaged");
  return sample;
}

}  // namespace pharos::gaussians
