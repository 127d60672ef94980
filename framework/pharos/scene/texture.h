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

  /// Returns the value at a surface point, which is finite. Reflectance must lie in [0, 1],
  /// radiance [W/(m^2 sr)] in [0, inf). A constant texture costs no virtual call.
  Rgb evaluate(const SurfacePoint& point) const {
    return is_constant_ ? constant_ : value_at(point);
  }

  /// The largest value of each channel over the texture, or a bound close to it; for range checks.
  virtual Rgb maximum() const = 0;
  /// The average over texture space; for light selection and albedo.
  virtual Rgb average() const = 0;

 protected:
  Texture() = default;
  /// A texture with the same value everywhere, which constant() returns.
  explicit Texture(Rgb constant) : is_constant_(true), constant_(constant) {}
  Rgb constant() const { return constant_; }

 private:
  /// Returns what evaluate() promises.
  virtual Rgb value_at(const SurfacePoint& point) const = 0;

  bool is_constant_ = false;
  Rgb constant_;
};

}  // namespace pharos
