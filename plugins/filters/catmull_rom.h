#pragma once

#include <pharos/config/schema.h>
#include <pharos/rendering/filter.h>

#include "mitchell.h"

namespace pharos {

/// See catmull_rom.cpp.
class CatmullRomFilter final : public Filter {
 public:
  struct Settings {
    float radius = 2;
    static void describe(Schema<Settings>& s);
  };
  explicit CatmullRomFilter(const Settings& settings)
      : cubic_({.b = 0, .c = 0.5f, .radius = settings.radius}) {}

  float radius() const override { return cubic_.radius(); }
  float evaluate(Vec2 offset) const override { return cubic_.evaluate(offset); }
  float integral() const override { return cubic_.integral(); }

 private:
  MitchellFilter cubic_;
};

}  // namespace pharos
