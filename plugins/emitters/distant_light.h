#pragma once

#include <pharos/core/warp.h>
#include <pharos/scene/emitter.h>

namespace pharos {

/// Returns a light sample from infinitely far away. The unit vector `direction` points towards the
/// light. The point that represents the light lies outside the scene's sphere for every `from`.
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

/// The density of the positions of rays from infinitely far away [1/m^2]. Rays are spread evenly
/// over the disk that the scene's sphere shows to every direction.
inline float distant_position_pdf(const EmitterSite& site) {
  return 1 / (kPi * square(site.scene_radius));
}

/// Returns a ray from infinitely far away that crosses the scene's sphere. `towards` points to its
/// origin and was drawn with density `pdf` [1/sr]. For a light of a single direction, `pdf` is 1
/// and `radiance` is the irradiance.
inline EmissionSample distant_emission(const EmitterSite& site, Vec3 towards, Rgb radiance,
                                       float pdf, Vec2 u_position) {
  EmissionSample sample{.direction = -towards, .kind = VertexKind::environment};
  const Vec2 on_disk = site.scene_radius * warp::disk_from_square(u_position);
  const Frame frame = Frame::from_normal(towards);
  sample.point.position =
      site.scene_center + frame.to_world({on_disk.x, on_disk.y, 1.01f * site.scene_radius});
  sample.point.normal = -towards;
  sample.point.shading = Frame::from_normal(-towards);
  if (!(pdf > 0) || is_black(radiance)) return sample;
  sample.pdf = {distant_position_pdf(site), pdf};
  sample.weight = radiance / (sample.pdf.position * pdf);
  return sample;
}

/// The power that enters the scene's sphere [W] if the irradiances at normal incidence from all
/// directions add up to `irradiance` [W/m^2]. The sphere shows the same disk to all directions.
inline float power_into_scene(const EmitterSite& site, float irradiance) {
  return kPi * square(site.scene_radius) * irradiance;
}

}  // namespace pharos
