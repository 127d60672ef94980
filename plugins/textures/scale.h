#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// See scale.cpp.
class ScaleTexture final : public Texture {
 public:
  struct Settings {
    Ref<Texture> texture;
    Ref<Texture> factor;
    static void describe(Schema<Settings>& s);
  };
  explicit ScaleTexture(Settings settings);

  Rgb value_at(const SurfacePoint& point) const override {
    return settings_.texture->evaluate(point) * settings_.factor->evaluate(point);
  }
  Rgb maximum() const override {
    return settings_.texture->maximum() * settings_.factor->maximum();
  }
  Rgb average() const override { return average_; }

 private:
  Settings settings_;
  Rgb average_;
};

}  // namespace pharos
