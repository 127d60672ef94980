#pragma once

#include <pharos/scene/emitter.h>

namespace pharos {

/// A light sample from infinitely far away: unit `direction` points to where the light comes from.
/// Its stand-in lies outside the scene's sphere wherever `from` is.
inline LightSample distant_sample(const EmitterSite& site, Point3 from, Vec3 direction,
                                  Rgb radiance, float pdf) {
  LightSample sample;
  sample.direction = direction;
  sample.distance = kInfinity;
  sample.radiance = radiance;
  sample.pdf = pdf;
  sample.kind = VertexKind::environment;
  const float beyond = 2 * site.scene_radius + length(from - site.scene_center);
  sample.point.position = from + beyond * direction;
  sample.point.normal = -direction;
  sample.point.shading = Frame::from_normal(-direction);
  return sample;
}

/// Power that enters the scene's sphere [W] when the irradiances at normal incidence from all
/// directions add up to `irradiance` [W/m^2]: the sphere shows the same disk to all of them.
inline float power_into_scene(const EmitterSite& site, float irradiance) {
  return kPi * square(site.scene_radius) * irradiance;
}

}  // namespace pharos
