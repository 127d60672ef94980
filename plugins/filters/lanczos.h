#pragma once

#include <pharos/config/schema.h>
#include <pharos/rendering/filter.h>

namespace pharos {

/// See lanczos.cpp.
class LanczosFilter final : public Filter {
 public:
  struct Settings {
    int lobes = 3;
    static void describe(Schema<Settings>& s);
  };
  explicit LanczosFilter(const Settings& settings);

  float radius() const override { return radius_; }
  float evaluate(Vec2 offset) const override { return profile(offset.x) * profile(offset.y); }
  float integral() const override { return integral_; }

 private:
  float profile(float x) const;

  float radius_, integral_;
};

}  // namespace pharos
