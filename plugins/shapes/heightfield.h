#pragma once

#include <vector>

#include <pharos/config/registry.h>
#include <pharos/scene/texture.h>

#include "triangle_shape.h"

namespace pharos {

/// See heightfield.cpp.
class Heightfield : public TriangleShape {
 public:
  struct Settings {
    Ref<Texture> texture = {};
    std::vector<int> resolution = {129, 129};
    float height = 1;
    bool smooth = true;
    Transform to_world = {};
    bool flip_normals = false;
    static void describe(Schema<Settings>& s);
  };

  explicit Heightfield(const Settings& settings);

  /// Returns the tangents of the smooth surface, orthogonal to the shading normal, if `smooth` is
  /// set.
  UvTangents uv_tangents(const SurfacePoint& point) const override;

 private:
  Vec3 along_u_, along_v_, upwards_;  ///< the edges of the flat square and the direction of
                                      ///< heights, in world space
};

}  // namespace pharos
