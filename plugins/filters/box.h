#pragma once

#include <pharos/config/schema.h>
#include <pharos/rendering/filter.h>

namespace pharos {

class BoxFilter final : public Filter {
 public:
  struct Settings {
    float radius = 0.5f;
    static void describe(Schema<Settings>& s);
  };
  explicit BoxFilter(const Settings& settings) : radius_(settings.radius) {}

  float radius() const override { return radius_; }
  float evaluate(Vec2 offset) const override {
    return std::abs(offset.x) <= radius_ && std::abs(offset.y) <= radius_ ? 1.0f : 0.0f;
  }
  float integral() const override { return 4 * radius_ * radius_; }

 private:
  float radius_;
};

}  // namespace pharos
