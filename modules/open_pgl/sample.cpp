#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/guiding/toolkit/guidable_steps.h>
#include <pharos/guiding/toolkit/image_distance.h>

namespace pharos::open_pgl {
namespace {

bool is_sound(const Sample& s) {
  bool sound = s.weight >= 0 && s.pdf > 0 && s.distance > 0;
  for (const float v : {s.weight, s.pdf, s.distance}) sound = sound && std::isfinite(v);
  for (int axis = 0; axis < 3; ++axis) sound = sound && std::isfinite(s.position[axis]);
  return sound && std::abs(length_squared(s.direction) - 1) < 1e-3f;
}

}  // namespace

void extract_samples(const PathView& path, const SampleRule& rule, PathScratch& scratch,
                     std::vector<Sample>& samples) {
  image_distances(path, rule.glossy, scratch.distances);
  for_each_guidable_step(path, scratch.incident, [&](const GuidableStep& step) {
    const float pdf = std::max(step.pdf, rule.least_pdf);
    const Sample sample{
        .position = step.from.position,
        .direction = step.from.direction,
        .distance = std::min(scratch.distances[step.number], rule.most_distance),
        .weight = mean(step.radiance) / pdf,
        .pdf = pdf,
        .in_volume = step.from.kind == VertexKind::volume,
    };
    if (is_sound(sample)) samples.push_back(sample);
  });
}

void Sample::archive(Archive& archive) {
  archive(position, direction, distance, weight, pdf, in_volume);
  archive.expect(is_sound(*this), "a sample for Open PGL");
}

}  // namespace pharos::open_pgl
