#pragma once

#include <array>
#include <cmath>

#include <pharos/core/bounds.h>
#include <pharos/core/ray.h>
#include <pharos/core/transform.h>
#include <pharos/scene/surface_point.h>

namespace pharos {

/// The uncertainty of a point on a placed surface.
struct PlacementError {
  float world = 0;   ///< SurfacePoint::error in world space [scene units]
  float margin = 0;  ///< distance to keep from the edges in local space [local units]
};

/// Returns the length. Its square may be beyond the range of a float, but not of a double.
inline double precise_length(Vec3 v) {
  const double x = v.x, y = v.y, z = v.z;
  return std::sqrt(x * x + y * y + z * z);
}

/// Returns the bounding box of a placed box; empty for an empty one. Throws InputError if the box
/// is beyond the range of a float.
Bounds3 placed_bounds(const Bounds3& local, const Transform& to_world);

/// The place of a group: takes rays to the group's local space and surface points back to world
/// space. The outer side of a surface stays its outer side even if the map mirrors.
class Placement {
 public:
  explicit Placement(const Transform& to_world);

  /// `ray` in local space. A distance t in world space is the distance `scale` * t in local space.
  struct LocalRay {
    Ray ray;
    float scale;
  };
  LocalRay to_local(const Ray& ray) const;

  /// Returns how far from the surface rays that leave it must start. `local` is a point of the
  /// surface in local space.
  PlacementError error_at(const SurfacePoint& local) const;
  /// Returns the point in world space; `error` is PlacementError::world of error_at().
  SurfacePoint to_world(const SurfacePoint& local, float error) const;
  /// Returns the tangents in world space.
  UvTangents to_world(const UvTangents& local) const {
    return {to_world_.vector(local.du), to_world_.vector(local.dv)};
  }

 private:
  Transform to_world_;
  std::array<Vec3, 3> inverse_magnitude_;  ///< its columns; see error_at()
  float condition_;                        ///< see error_at()
};

}  // namespace pharos
