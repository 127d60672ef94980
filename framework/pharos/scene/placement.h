#pragma once

#include <array>

#include <pharos/core/bounds.h>
#include <pharos/core/ray.h>
#include <pharos/core/transform.h>
#include <pharos/scene/surface_point.h>

namespace pharos {

/// How uncertain a point of a placed surface is.
struct PlacementError {
  float world = 0;   ///< SurfacePoint::error in world space [scene units]
  float margin = 0;  ///< what to keep from the edges in local space [local units]
};

/// The box of a placed box; empty for an empty one. Throws InputError where a float cannot hold it.
Bounds3 placed_bounds(const Bounds3& local, const Transform& to_world);

/// Where a group stands: takes rays to the group's local space and surface points back to world
/// space. The outer side of a surface stays its outer side, mirrored or not.
class Placement {
 public:
  explicit Placement(const Transform& to_world);

  /// `ray` in local space; a distance t along the one is `scale` * t along the other.
  struct LocalRay {
    Ray ray;
    float scale;
  };
  LocalRay to_local(const Ray& ray) const;

  /// How far off a surface rays must start that leave it, given a point of it in local space.
  PlacementError error_at(const SurfacePoint& local) const;
  /// The point in world space; `error` is that of error_at().
  SurfacePoint to_world(const SurfacePoint& local, float error) const;
  /// Tangents in world space.
  UvTangents to_world(const UvTangents& local) const {
    return {to_world_.vector(local.du), to_world_.vector(local.dv)};
  }

 private:
  Transform to_world_;
  std::array<Vec3, 3> inverse_magnitude_;  ///< columns; see error_at()
  float condition_;                        ///< see error_at()
};

}  // namespace pharos
