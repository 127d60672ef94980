#pragma once

#include <pharos/core/rgb.h>

namespace pharos {

/// A matt base under a clear coat. Light that enters through the coat is scattered by the base; a
/// share of it leaves, the rest is reflected back onto the base by the coat's inner side, again and
/// again. With the coat's transmittance T(c) from outside, its mean T' over the hemisphere, the
/// mean reflectance F' of the inner side and the base's reflectance a,
///
///     f = T(o) T(i) / (pi eta^2) a / (1 - a F'),   1 - F' = T' / eta^2,
///
/// where the second is reciprocity. Hence f cos(i) integrates to T(o) s(a), and the share
/// s(a) = (1 - F') a / (1 - a F') of what has entered is one for a white base.
class DiffuseBase {
 public:
  /// `transmittance`: the mean T' [1]; `ior` of the coat over outside, at least 1. Without
  /// `nonlinear` the base's color does not deepen with every reflection: s(a) = a.
  DiffuseBase(float transmittance, float ior, bool nonlinear)
      : transmittance_(transmittance),
        escaping_(transmittance / (ior * ior)),
        nonlinear_(nonlinear) {}

  /// The share s(a) [1] of light in the coat that leaves it in the end.
  Rgb emerging(Rgb reflectance) const {
    if (!nonlinear_) return reflectance;
    // 1 - a F' in a form that keeps the digits of small 1 - F'.
    return escaping_ * reflectance / (Rgb(1) - reflectance + escaping_ * reflectance);
  }

  /// Value f |cos| over the density cos / pi [1], for a share `emerging` and the coat's
  /// transmittances towards both directions.
  Rgb weight(Rgb emerging, float entering, float leaving) const {
    return (entering * leaving / transmittance_) * emerging;
  }

  /// Share [1] of light from everywhere above that base and coat reflect together.
  Rgb albedo(Rgb reflectance, Rgb specular_reflectance) const {
    return (1 - transmittance_) * specular_reflectance + transmittance_ * emerging(reflectance);
  }

 private:
  float transmittance_;
  float escaping_;  ///< 1 - F'
  bool nonlinear_;
};

}  // namespace pharos
