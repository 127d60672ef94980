#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>
#include <pharos/guiding/guidable_steps.h>

namespace pharos::vmf {
namespace {

/// How much of what lies behind a vertex counts for who looks at it: nothing on rough surfaces.
float share_behind(const RecordedVertex& vertex, const RecordedVertex& from, float glossy) {
  const bool shows = vertex.kind == VertexKind::surface && vertex.event != Event::none &&
                     (is_discrete(vertex.event) || vertex.roughness < glossy);
  if (!shows) return 0;
  const bool refracts =
      vertex.event == Event::smooth_transmit || vertex.event == Event::discrete_transmit;
  if (!refracts) return 1;
  // Angles behind the surface, over those before it.
  const float in = std::abs(dot(from.direction, vertex.normal));
  const float out = std::abs(dot(vertex.direction, vertex.normal));
  const float scale = out / (in * vertex.eta);
  return std::isfinite(scale) ? scale : 0;
}

/// Distance of the image that a step from each vertex shows; of the first step where it branches.
void image_distances(const PathView& path, float glossy, std::vector<float>& distances) {
  distances.assign(path.vertices.size(), 0);
  for (std::size_t i = path.vertices.size(); i-- > 1;) {
    const RecordedVertex& vertex = path.vertices[i];
    if (vertex.parent == kNoVertex) continue;
    const RecordedVertex& from = path.vertices[vertex.parent];
    const bool escapes = vertex.kind == VertexKind::environment;
    const float share = share_behind(vertex, from, glossy);
    distances[vertex.parent] =
        escapes ? kInfinity
                : length(vertex.position - from.position) + (share > 0 ? share * distances[i] : 0);
  }
}

}  // namespace

void extract_samples(const PathView& path, const SampleRule& rule, PathScratch& scratch,
                     std::vector<Sample>& samples) {
  image_distances(path, rule.glossy, scratch.distances);
  for_each_guidable_step(path, scratch.incident, [&](const GuidableStep& step) {
    const float pdf = std::max(step.pdf, rule.least_pdf);
    const float weight = mean(step.radiance) / pdf;
    const float inverse = 1 / scratch.distances[step.number];
    if (!(weight >= 0) || !std::isfinite(weight) || !std::isfinite(pdf)) return;
    if (!std::isfinite(inverse)) return;
    samples.push_back({.origin = step.from.position,
                       .direction = step.from.direction,
                       .inverse_distance = inverse,
                       .weight = weight,
                       .pdf = pdf});
  });
}

void save_sample(const Sample& sample, std::ostream& out) {
  for (int axis = 0; axis < 3; ++axis) save_number(out, sample.origin[axis]);
  for (int axis = 0; axis < 3; ++axis) save_number(out, sample.direction[axis]);
  for (const float v : {sample.inverse_distance, sample.weight, sample.pdf}) save_number(out, v);
}

Sample load_sample(std::istream& in) {
  Sample sample;
  for (int axis = 0; axis < 3; ++axis) sample.origin[axis] = load_finite<float>(in);
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = load_finite<float>(in);
  for (float* v : {&sample.inverse_distance, &sample.weight, &sample.pdf}) {
    *v = load_finite<float>(in);
  }
  const bool is_sound = sample.weight >= 0 && sample.pdf > 0 && sample.inverse_distance >= 0 &&
                        std::abs(length_squared(sample.direction) - 1) < 1e-3f;
  if (!is_sound) throw InputError("a sample of the von Mises-Fisher mixtures is damaged");
  return sample;
}

}  // namespace pharos::vmf
