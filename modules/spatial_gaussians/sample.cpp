#include "sample.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>
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
    // So close that rounding leaves no direction.
    if (!(length_squared(target - origin) > 0)) return;
    samples.push_back({.origin = origin, .target = target, .weight = weight, .pdf = pdf});
  });
}

void Sample::save(std::ostream& out) const {
  for (const Point3 p : {origin, target}) {
    for (int axis = 0; axis < 3; ++axis) save_number(out, p[axis]);
  }
  save_number(out, weight);
  save_number(out, pdf);
}

Sample Sample::load(std::istream& in) {
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

}  // namespace pharos::spatial_gaussians
