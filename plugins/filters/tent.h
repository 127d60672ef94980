#pragma once

#include <pharos/config/schema.h>
#include <pharos/rendering/filter.h>

namespace pharos {

/// See tent.cpp.
class TentFilter final : public Filter {
 public:
  struct Settings {
    float radius = 1;
    static void describe(Schema<Settings>& s);
  };
  explicit TentFilter(const Settings& settings) : radius_(settings.radius) {}

  float radius() const override { return radius_; }
  float evaluate(Vec2 offset) const override { return profile(offset.x) * profile(offset.y); }
  float integral() const override { return radius_ * radius_; }

 private:
  float profile(float x) const { return std::max(0.0f, 1 - std::abs(x) / radius_); }

  float radius_;
};

}  // namespace pharos
