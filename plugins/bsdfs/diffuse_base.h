#pragma once

#include <pharos/core/rgb.h>

namespace pharos {

/// A matt base under a clear coat. The base scatters the light that enters through the coat. One
/// share of this light leaves; the coat's inner side reflects the rest back onto the base, again
/// and again. Let T(c) be the coat's transmittance from outside, T' its mean over the hemisphere,
/// F' the mean reflectance of the inner side and a the base's reflectance. Then
///
///     f = T(o) T(i) / (pi eta^2) a / (1 - a F'),   1 - F' = T' / eta^2,
///
/// where the second equation follows from reciprocity. Hence f cos(i) integrates to T(o) s(a). The
/// share s(a) = (1 - F') a / (1 - a F') of the light that has entered is one for a white base.
class DiffuseBase {
 public:
  /// Takes the mean transmittance T' [1] and the index `ior` of the coat relative to the outside,
  /// at least 1. If `nonlinear` is false, repeated reflection does not deepen the base's color:
  /// s(a) = a.
  DiffuseBase(float transmittance, float ior, bool nonlinear)
      : transmittance_(transmittance),
        escaping_(transmittance / (ior * ior)),
        nonlinear_(nonlinear) {}

  /// The share s(a) [1] of the light inside the coat that finally leaves it.
  Rgb emerging(Rgb reflectance) const {
    if (!nonlinear_) return reflectance;
    // This form of 1 - a F' keeps the digits of a small 1 - F'.
    return escaping_ * reflectance / (Rgb(1) - reflectance + escaping_ * reflectance);
  }

  /// The value f |cos| divided by the density cos / pi [1], for a share `emerging` and the coat's
  /// transmittances `entering` and `leaving` in both directions.
  Rgb weight(Rgb emerging, float entering, float leaving) const {
    return (entering * leaving / transmittance_) * emerging;
  }

  /// The share [1] of uniform light from above that base and coat reflect together.
  Rgb albedo(Rgb reflectance, Rgb specular_reflectance) const {
    return (1 - transmittance_) * specular_reflectance + transmittance_ * emerging(reflectance);
  }

 private:
  float transmittance_;
  float escaping_;  ///< 1 - F'
  bool nonlinear_;
};

}  // namespace pharos
