#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// See mix.cpp.
class MixTexture final : public Texture {
 public:
  struct Settings {
    Ref<Texture> first, second, weight;
    static void describe(Schema<Settings>& s);
  };
  explicit MixTexture(Settings settings);

  Rgb value_at(const SurfacePoint& point) const override;
  Rgb maximum() const override;
  Rgb average() const override { return average_; }

 private:
  Settings settings_;
  Rgb average_;
};

}  // namespace pharos
