#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

namespace pharos {

/// See constant.cpp.
class ConstantEmitter : public Emitter {
 public:
  struct Settings {
    Rgb radiance{1};
    float scale = 1;
    static void describe(Schema<Settings>& s);
  };

  explicit ConstantEmitter(const Settings& settings)
      : radiance_(settings.scale * settings.radiance) {}

  bool needs_shape() const override { return false; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Rgb radiance_;
};

}  // namespace pharos
