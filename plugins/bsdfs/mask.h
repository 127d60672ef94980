#pragma once

#include <pharos/config/schema.h>

#include "mixed_bsdf.h"

namespace pharos {

/// See mask.cpp.
class Mask final : public MixedBsdf {
 public:
  struct Settings {
    Ref<Bsdf> bsdf;
    Ref<Texture> opacity;
    static void describe(Schema<Settings>& s);
  };
  explicit Mask(const Settings& settings);
};

}  // namespace pharos
