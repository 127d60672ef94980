#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/texture.h>

namespace pharos {

class Checkerboard final : public Texture {
 public:
  struct Settings {
    Rgb color0{0.4f};
    Rgb color1{0.2f};
    Vec2 uv_scale{1, 1};
    static void describe(Schema<Settings>& s);
  };
  explicit Checkerboard(const Settings& settings) : settings_(settings) {}

  Rgb value_at(const SurfacePoint& point) const override;
  Rgb maximum() const override { return max(settings_.color0, settings_.color1); }
  Rgb average() const override { return 0.5f * (settings_.color0 + settings_.color1); }

 private:
  Settings settings_;
};

}  // namespace pharos
