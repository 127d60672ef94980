#pragma once

#include <cstdint>

#include <pharos/core/frame.h>
#include <pharos/core/vec.h>

namespace pharos {

/// How a point of a surface moves with its texture coordinates.
struct UvTangents {
  Vec3 du;  ///< derivative of the position by u, zero where it has none [scene units]
  Vec3 dv;  ///< the same by v
};

/// A point on a shape's surface, as found by a ray or by sampling.
struct SurfacePoint {
  Point3 position;           ///< [scene units]
  Vec3 normal;               ///< geometric, unit, on the shape's outer side
  Frame shading;             ///< shading frame; its normal lies on the same side as `normal`. s is
                             ///< along tangents.du where there is one; else s and t are arbitrary
                             ///< and may jump
  Vec2 uv;                   ///< texture coordinates
  float error = 0;           ///< bound on the error of `position` [scene units]
  std::uint32_t object = 0;  ///< index into Scene::objects()
  std::uint32_t primitive = 0;  ///< triangle or primitive within the shape
  UvTangents tangents;          ///< at hits of rays on materials that need them; else zero

  /// Gives the point tangents and turns the shading frame along them: s towards du, as far as it is
  /// orthogonal to the shading normal. Where du is zero, not finite or along the normal, s and t
  /// are arbitrary.
  void set_tangents(const UvTangents& along);

  /// Where a ray towards `direction` starts so that it does not meet this surface again. Moves
  /// along the normal by a multiple of `error`, so it scales with the scene.
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
