#pragma once

#include <vector>

#include <pharos/config/registry.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// See uv_map.cpp.
class UvMapTexture final : public Texture {
 public:
  struct Settings {
    Ref<Texture> texture;
    std::vector<float> matrix = {1, 0, 0, 0, 1, 0};
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError unless the matrix has six numbers.
  explicit UvMapTexture(Settings settings);

  Rgb value_at(const SurfacePoint& point) const override;
  Rgb maximum() const override { return settings_.texture->maximum(); }
  Rgb average() const override { return settings_.texture->average(); }

 private:
  Settings settings_;
};

}  // namespace pharos
