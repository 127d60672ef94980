#pragma once

#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/rgb.h>
#include <pharos/scene/surface_point.h>

namespace pharos {

/// Contract: a color that varies over surfaces. Thread-safe and free of randomness.
class Texture : public Component {
 public:
  static constexpr std::string_view contract_name = "texture";

  /// The value at a surface point, which is finite. Reflectance must lie in [0, 1], radiance
  /// [W/(m^2 sr)] in [0, inf).
  virtual Rgb evaluate(const SurfacePoint& point) const = 0;

  /// The largest value of each channel over the texture, or a bound close to it; for range checks.
  virtual Rgb maximum() const = 0;
  /// The average over texture space; for light selection and albedo.
  virtual Rgb average() const = 0;
};

}  // namespace pharos
