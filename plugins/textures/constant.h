#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/texture.h>

namespace pharos {

class ConstantTexture final : public Texture {
 public:
  struct Settings {
    Rgb value{0.5f};
    static void describe(Schema<Settings>& s);
  };
  explicit ConstantTexture(const Settings& settings) : Texture(settings.value) {}

  Rgb value_at(const SurfacePoint&) const override { return constant(); }
  Rgb maximum() const override { return constant(); }
  Rgb average() const override { return constant(); }
};

}  // namespace pharos
