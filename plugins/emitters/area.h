#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// See area.cpp.
class AreaEmitter : public Emitter {
 public:
  struct Settings {
    Ref<Texture> radiance = {};
    float scale = 1;
    static void describe(Schema<Settings>& s);
  };

  explicit AreaEmitter(Settings settings) : settings_(std::move(settings)) {}

  bool needs_shape() const override { return true; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
