#pragma once

#include <pharos/config/schema.h>
#include <pharos/rendering/filter.h>

namespace pharos {

class GaussianFilter final : public Filter {
 public:
  struct Settings {
    float stddev = 0.5f;
    float radius = 1.5f;
    static void describe(Schema<Settings>& s);
  };
  explicit GaussianFilter(const Settings& settings);

  float radius() const override { return settings_.radius; }
  float evaluate(Vec2 offset) const override { return profile(offset.x) * profile(offset.y); }
  float integral() const override { return integral_; }

 private:
  float profile(float x) const;

  Settings settings_;
  float exponent_;  ///< -1 / (2 stddev^2)
  float floor_;     ///< the Gaussian at the radius
  float integral_;
};

}  // namespace pharos
