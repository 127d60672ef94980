#pragma once

#include <pharos/core/rgb.h>

namespace pharos {

/// Mean of f(cosine) over the cosine-weighted hemisphere, the integral of 2 c f(c) dc over [0, 1]
/// [unit of f]. The midpoint rule is good to about 1e-6 for Fresnel's equations.
template <class F>
float hemisphere_mean(const F& f) {
  constexpr int kPoints = 1024;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double cosine = (i + 0.5) / kPoints;
    sum += 2 * cosine * double{f(static_cast<float>(cosine))};
  }
  return static_cast<float>(sum / kPoints);
}

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
  /// `nonlinear` the base's colour does not deepen with every reflection: s(a) = a.
  DiffuseBase(float transmittance, float ior, bool nonlinear)
      : transmittance_(transmittance),
        internal_(1 - transmittance / (ior * ior)),
        nonlinear_(nonlinear) {}

  /// The share s(a) [1] of light in the coat that leaves it in the end.
  Rgb emerging(Rgb reflectance) const {
    if (!nonlinear_) return reflectance;
    return (1 - internal_) * reflectance / (Rgb(1) - internal_ * reflectance);
  }

  /// Value f |cos| over the density cos / pi [1], for the coat's transmittances towards both
  /// directions.
  Rgb weight(Rgb reflectance, float entering, float leaving) const {
    return (entering * leaving / transmittance_) * emerging(reflectance);
  }

  /// Share [1] of light from everywhere above that base and coat reflect together.
  Rgb albedo(Rgb reflectance, Rgb specular_reflectance) const {
    return (1 - transmittance_) * specular_reflectance + transmittance_ * emerging(reflectance);
  }

 private:
  float transmittance_;
  float internal_;  ///< F'
  bool nonlinear_;
};

}  // namespace pharos
