#pragma once

#include <cstdint>

#include <pharos/core/frame.h>
#include <pharos/core/vec.h>

namespace pharos {

/// The derivatives of a surface's position by its texture coordinates.
struct UvTangents {
  Vec3 du;  ///< derivative of the position by u; zero if there is none [scene units]
  Vec3 dv;  ///< derivative of the position by v; zero if there is none [scene units]
};

/// A point on a shape's surface, found by a ray or by sampling.
struct SurfacePoint {
  Point3 position;  ///< [scene units]
  Vec3 normal;      ///< geometric, unit, on the shape's outer side
  Frame shading;    ///< its normal lies on the same side as `normal`; s points along tangents.du if
                    ///< the point has tangents, otherwise s and t are arbitrary and may jump
  Vec2 uv;          ///< texture coordinates
  float error = 0;  ///< bound on the error of `position` [scene units]
  std::uint32_t object = 0;     ///< index into Scene::objects()
  std::uint32_t primitive = 0;  ///< triangle or primitive within the shape
  UvTangents tangents;  ///< set at hits of rays on materials that need tangents; otherwise zero

  /// Sets the tangents and rotates the shading frame about its normal. s then points along the part
  /// of du that is orthogonal to the shading normal. If du is zero, not finite or along the normal,
  /// s and t are arbitrary.
  void set_tangents(const UvTangents& along);

  /// Returns the origin of a ray towards `direction` that does not meet this surface again. The
  /// origin is moved along the normal by `error`, so it scales with the scene.
  Point3 origin_towards(Vec3 direction) const {
    const float offset = dot(direction, normal) >= 0 ? error : -error;
    return position + offset * normal;
  }
};

inline void SurfacePoint::set_tangents(const UvTangents& along) {
  tangents = along;
  shading = Frame::along(shading.n, along.du);
}

}  // namespace pharos
