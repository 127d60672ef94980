#pragma once

#include <cmath>

#include <pharos/guiding/contract/guider.h>
#include <pharos/scene/local_scattering.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A vertex that a path has reached or begins at.
struct PathVertex {
  VertexKind kind = VertexKind::sensor;
  SurfacePoint surface;  ///< off surfaces only `position` is set, on the lens also the normal
  const Medium* medium = nullptr;  ///< medium through which the path came

  Point3 position() const { return surface.position; }
  bool is_on_surface() const { return kind == VertexKind::surface; }

  /// Returns the origin of a ray that leaves here in `direction`; medium_towards() returns its
  /// medium.
  Point3 origin_towards(Vec3 direction) const {
    return is_on_surface() ? surface.origin_towards(direction) : position();
  }
  const Medium* medium_towards(const Scene& scene, Vec3 direction) const {
    return is_on_surface() ? scene.medium_after(surface, direction, medium) : medium;
  }

  /// Returns the scattering at a surface or volume vertex. The result refers to this vertex.
  LocalScattering scattering(const Scene& scene, Vec3 towards_previous, Transport transport) const {
    if (is_on_surface()) {
      return {surface, scene.bsdf(surface), scene.events(surface), towards_previous, transport};
    }
    return {medium->phase_function(), medium->scattering(position()), towards_previous, transport};
  }

  /// Returns LocalScattering::roughness() at this vertex; 1 if nothing scatters here.
  float roughness(const Scene& scene) const {
    if (is_on_surface()) return scene.bsdf(surface).roughness(surface);
    if (kind != VertexKind::volume) return 1;
    return 1 - std::abs(medium->phase_function().mean_cosine());
  }
  /// Fills in the description of the vertex for guides, without the event.
  void describe(float roughness, GuidingVertex& out) const {
    const bool has_normal = is_on_surface() || kind == VertexKind::sensor;
    out.position = position();
    out.normal = has_normal ? surface.normal : Vec3{};
    out.shading_normal = has_normal ? surface.shading.n : Vec3{};
    out.kind = kind;
    out.event = Event::none;
    out.roughness = roughness;
  }
  /// Returns what describe() fills in.
  GuidingVertex described(float roughness = 1) const {
    GuidingVertex result;
    describe(roughness, result);
    return result;
  }
};

/// Returns the ray from `origin` to `goal`, which lies approximately in `direction`.
inline Ray ray_between(Point3 origin, Point3 goal, Vec3 direction) {
  const Vec3 span = goal - origin;
  Ray ray{origin, direction, length(span)};
  if (ray.t_max > 0) ray.direction = span / ray.t_max;
  return ray;
}

}  // namespace pharos
