#pragma once

#include <cstdint>

#include <pharos/core/frame.h>
#include <pharos/core/vec.h>

namespace pharos {

/// A point on a shape's surface, as found by a ray or by sampling.
struct SurfacePoint {
  Point3 position;           ///< [scene units]
  Vec3 normal;               ///< geometric, unit, on the shape's outer side
  Frame shading;             ///< shading frame; its normal lies on the same side as `normal`, the
                             ///< other axes are arbitrary and may jump
  Vec2 uv;                   ///< texture coordinates
  float error = 0;           ///< bound on the error of `position` [scene units]
  std::uint32_t object = 0;  ///< index into Scene::objects()
  std::uint32_t primitive = 0;  ///< triangle or primitive within the shape

  /// Where a ray towards `direction` starts so that it does not meet this surface again. Moves
  /// along the normal by a multiple of `error`, so it scales with the scene.
  Point3 origin_towards(Vec3 direction) const {
    const float offset = dot(direction, normal) >= 0 ? error : -error;
    return position + offset * normal;
  }
};

}  // namespace pharos
