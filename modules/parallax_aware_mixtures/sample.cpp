#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>
#include <pharos/guiding/toolkit/guidable_steps.h>
#include <pharos/guiding/toolkit/image_distance.h>

namespace pharos::parallax_aware_mixtures {

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

void Sample::save(std::ostream& out) const {
  for (int axis = 0; axis < 3; ++axis) save_number(out, origin[axis]);
  for (int axis = 0; axis < 3; ++axis) save_number(out, direction[axis]);
  for (const float v : {inverse_distance, weight, pdf}) save_number(out, v);
}

Sample Sample::load(std::istream& in) {
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

}  // namespace pharos::parallax_aware_mixtures
