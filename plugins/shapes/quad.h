#pragma once

#include <pharos/config/schema.h>

#include "triangle_shape.h"

namespace pharos {

/// See quad.cpp.
class Quad : public TriangleShape {
 public:
  struct Settings {
    Transform to_world = {};
    bool flip_normals = false;
    static void describe(Schema<Settings>& s);
  };

  explicit Quad(const Settings& settings);

  /// Affine in `u`: the sampled point has the texture coordinates u.
  ShapeSample sample(Vec2 u) const override;

 private:
  Point3 corner_;  ///< the point with u = (0, 0)
  Vec3 edge_u_, edge_v_;
  SurfacePoint common_;  ///< the data that all points share
};

}  // namespace pharos
