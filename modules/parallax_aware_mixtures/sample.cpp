#include "sample.h"

#include <algorithm>
#include <cmath>

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
                       .pdf = pdf,
                       .steps = step.from.continuation});
  });
}

void Sample::archive(Archive& archive) {
  archive(origin, direction, inverse_distance, weight, pdf, steps);
  archive.expect(weight >= 0 && pdf > 0 && steps > 0 && inverse_distance >= 0 &&
                     std::abs(length_squared(direction) - 1) < 1e-3f,
                 "a sample of the von Mises-Fisher mixtures");
}

}  // namespace pharos::parallax_aware_mixtures
