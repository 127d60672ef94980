#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/texture.h>

#include "tilted_bsdf.h"

namespace pharos {

/// See bump_map.cpp.
class BumpMap final : public TiltedBsdf {
 public:
  struct Settings {
    Ref<Bsdf> bsdf;
    Ref<Texture> texture;
    float height = 1;
    float step = 1e-3f;
    static void describe(Schema<Settings>& s);
  };
  explicit BumpMap(const Settings& settings) : TiltedBsdf(settings.bsdf), settings_(settings) {}

 protected:
  Vec3 normal(const SurfacePoint& point) const override;

 private:
  /// Returns the displacement at texture coordinates moved by `offset` [scene units].
  float height_beside(const SurfacePoint& point, Vec2 offset) const;

  Settings settings_;
};

}  // namespace pharos
