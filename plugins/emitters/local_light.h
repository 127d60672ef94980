#pragma once

#include <pharos/scene/emitter.h>

namespace pharos {

/// Returns the only sample of a light without extent at `position`. `intensity(direction)` [W/sr]
/// is the intensity in a unit direction away from the light. The density is 0 if no light arrives,
/// or if the distance is so small that its inverse square is not finite.
template <class Intensity>
LightSample local_sample(Point3 position, Point3 from, const Intensity& intensity) {
  LightSample sample;
  const Vec3 d = position - from;
  sample.distance = length(d);
  const float inverse_square = 1 / square(sample.distance);
  if (!std::isfinite(inverse_square)) return sample;
  sample.direction = d / sample.distance;
  sample.radiance = inverse_square * intensity(-sample.direction);
  sample.pdf = is_black(sample.radiance) ? 0.0f : 1.0f;
  sample.discrete = true;
  sample.point.position = position;
  sample.point.normal = -sample.direction;
  sample.point.shading = Frame::from_normal(sample.point.normal);
  sample.kind = VertexKind::light;
  return sample;
}

/// Returns a ray that leaves a light without extent at `position` in `direction`. The direction was
/// drawn with density `pdf` [1/sr] and has the given `intensity` [W/sr].
inline EmissionSample local_emission(Point3 position, Vec3 direction, float pdf, Rgb intensity) {
  EmissionSample sample{.direction = direction, .kind = VertexKind::light};
  sample.point.position = position;
  sample.point.normal = direction;
  sample.point.shading = Frame::from_normal(direction);
  if (is_black(intensity)) return sample;
  sample.pdf = {1, pdf};
  sample.weight = intensity / pdf;
  return sample;
}

}  // namespace pharos
