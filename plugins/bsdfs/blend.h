#pragma once

#include <pharos/config/schema.h>

#include "mixed_bsdf.h"

namespace pharos {

/// See blend.cpp.
class Blend final : public MixedBsdf {
 public:
  struct Settings {
    Ref<Bsdf> first, second;
    Ref<Texture> weight;
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if `first` and `second` refract differently.
  explicit Blend(const Settings& settings);
};

}  // namespace pharos
