#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/guiding/toolkit/guidable_steps.h>

namespace pharos::spatial_gaussians {

void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples) {
  for_each_guidable_step(path, incident, [&](const GuidableStep& step) {
    const float pdf = std::max(step.pdf, rule.least_pdf);
    const float weight = mean(step.radiance) / pdf;
    if (!(weight >= 0) || !std::isfinite(weight) || !std::isfinite(pdf)) return;
    const Point3 origin = step.from.position;
    const bool escapes = step.to.kind == VertexKind::environment;
    const Point3 target =
        escapes ? origin + rule.environment_distance * step.from.direction : step.to.position;
    // The points are so close that rounding leaves no direction.
    if (!(length_squared(target - origin) > 0)) return;
    samples.push_back({.origin = origin,
                       .target = target,
                       .weight = weight,
                       .pdf = pdf,
                       .steps = step.from.continuation});
  });
}

void Sample::archive(Archive& archive) {
  archive(origin, target, weight, pdf, steps);
  archive.expect(weight >= 0 && pdf > 0 && steps > 0 && length_squared(target - origin) > 0,
                 "a sample of the Gaussians");
}

}  // namespace pharos::spatial_gaussians
