#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/scene/texture.h>

/// Vertical stripes in two colors.
class Stripes final : public pharos::Texture {
 public:
  struct Settings {
    pharos::Rgb first{0.9f};
    pharos::Rgb second{0.1f};
    float count = 8;

    static void describe(pharos::Schema<Settings>& s) {
      s.field("first", &Settings::first, "Color of even stripes").at_least(0);
      s.field("second", &Settings::second, "Color of odd stripes").at_least(0);
      s.field("count", &Settings::count, "Stripes in one unit of u").above(0);
    }
  };
  explicit Stripes(Settings settings) : settings_(settings) {}

  pharos::Rgb value_at(const pharos::SurfacePoint& point) const override {
    const float stripe = std::floor(point.uv.x * settings_.count);
    const bool odd = std::fmod(stripe, 2.0f) != 0;
    return odd ? settings_.second : settings_.first;
  }
  pharos::Rgb maximum() const override { return max(settings_.first, settings_.second); }
  pharos::Rgb average() const override { return 0.5f * (settings_.first + settings_.second); }

 private:
  Settings settings_;
};
