#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// See grid.cpp.
class GridTexture final : public Texture {
 public:
  struct Settings {
    Rgb color0{0.2f};
    Rgb color1{0.4f};
    float line_width = 0.01f;
    Vec2 uv_scale{1, 1};
    static void describe(Schema<Settings>& s);
  };
  explicit GridTexture(const Settings& settings) : settings_(settings) {}

  Rgb value_at(const SurfacePoint& point) const override;
  Rgb maximum() const override { return max(settings_.color0, settings_.color1); }
  Rgb average() const override;

 private:
  bool on_line(float coordinate) const;

  Settings settings_;
};

}  // namespace pharos
