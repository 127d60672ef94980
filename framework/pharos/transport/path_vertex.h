#pragma once

#include <cmath>

#include <pharos/guiding/contract/guider.h>
#include <pharos/scene/local_scattering.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A vertex that a path has reached or begins at.
struct PathVertex {
  VertexKind kind = VertexKind::sensor;
  SurfacePoint surface;  ///< off surfaces its `position` alone, on the lens the normal too
  const Medium* medium = nullptr;  ///< that the path came through

  Point3 position() const { return surface.position; }
  bool is_on_surface() const { return kind == VertexKind::surface; }

  /// Where a ray begins that leaves here, and the medium that it is in.
  Point3 origin_towards(Vec3 direction) const {
    return is_on_surface() ? surface.origin_towards(direction) : position();
  }
  const Medium* medium_towards(const Scene& scene, Vec3 direction) const {
    return is_on_surface() ? scene.medium_after(surface, direction, medium) : medium;
  }

  /// Refers to this vertex. Surface and volume vertices only.
  LocalScattering scattering(const Scene& scene, Vec3 towards_previous, Transport transport) const {
    if (is_on_surface()) return {surface, scene.bsdf(surface), towards_previous, transport};
    return {medium->phase_function(), medium->scattering(position()), towards_previous, transport};
  }

  /// That of LocalScattering; 1 where nothing scatters.
  float roughness(const Scene& scene) const {
    if (is_on_surface()) return scene.bsdf(surface).roughness(surface);
    if (kind != VertexKind::volume) return 1;
    return 1 - std::abs(medium->phase_function().mean_cosine());
  }
  /// What a guide may know of it, but for the event.
  GuidingVertex described(float roughness = 1) const {
    const bool has_normal = is_on_surface() || kind == VertexKind::sensor;
    return {.position = position(),
            .normal = has_normal ? surface.normal : Vec3{},
            .shading_normal = has_normal ? surface.shading.n : Vec3{},
            .kind = kind,
            .roughness = roughness};
  }
};

/// The ray from `origin` to `goal`, which lies in about `direction`.
inline Ray ray_between(Point3 origin, Point3 goal, Vec3 direction) {
  const Vec3 span = goal - origin;
  Ray ray{origin, direction, length(span)};
  if (ray.t_max > 0) ray.direction = span / ray.t_max;
  return ray;
}

}  // namespace pharos
