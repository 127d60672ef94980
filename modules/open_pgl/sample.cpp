#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>
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

void save_sample(const Sample& sample, std::ostream& out) {
  for (int axis = 0; axis < 3; ++axis) save_number(out, sample.position[axis]);
  for (int axis = 0; axis < 3; ++axis) save_number(out, sample.direction[axis]);
  for (const float v : {sample.distance, sample.weight, sample.pdf}) save_number(out, v);
  save_number(out, static_cast<std::uint8_t>(sample.in_volume));
}

Sample load_sample(std::istream& in) {
  Sample sample;
  for (int axis = 0; axis < 3; ++axis) sample.position[axis] = load_number<float>(in);
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = load_number<float>(in);
  for (float* v : {&sample.distance, &sample.weight, &sample.pdf}) *v = load_number<float>(in);
  sample.in_volume = load_number<std::uint8_t>(in) != 0;
  if (!is_sound(sample)) throw InputError("a sample for Open PGL is damaged");
  return sample;
}

}  // namespace pharos::open_pgl
