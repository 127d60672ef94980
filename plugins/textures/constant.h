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
  explicit ConstantTexture(const Settings& settings)
      : Texture(settings.value), value_(settings.value) {}

  Rgb maximum() const override { return value_; }
  Rgb average() const override { return value_; }

 private:
  Rgb value_;
};

}  // namespace pharos
