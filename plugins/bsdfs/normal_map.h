#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/texture.h>

#include "tilted_bsdf.h"

namespace pharos {

/// See normal_map.cpp.
class NormalMap final : public TiltedBsdf {
 public:
  struct Settings {
    Ref<Bsdf> bsdf;
    Ref<Texture> texture;
    static void describe(Schema<Settings>& s);
  };
  explicit NormalMap(const Settings& settings)
      : TiltedBsdf(settings.bsdf), texture_(settings.texture) {}

 protected:
  Vec3 normal(const SurfacePoint& point) const override;

 private:
  Ref<Texture> texture_;
};

}  // namespace pharos
