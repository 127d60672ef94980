#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>

#include "hemisphere_mean.h"

namespace pharos {

/// Reflection and refraction of unpolarized light at a smooth interface.
struct DielectricFresnel {
  float reflectance = 1;      ///< [1]; 1 for total internal reflection
  float cos_transmitted = 0;  ///< cosine of the refracted direction to the normal, >= 0
};

/// Evaluates the exact Fresnel equations between dielectrics. `cos_incident` is in [0, 1]; `eta` is
/// the refractive index beyond the interface relative to the index of the incident side.
inline DielectricFresnel dielectric_fresnel(float cos_incident, float eta) {
  if (eta == 1) return {0, cos_incident};  // exact: rounding would leave a trace of reflection
  const float sin_squared = std::max(0.0f, 1 - cos_incident * cos_incident) / (eta * eta);
  const float cos_squared = 1 - sin_squared;
  if (cos_squared <= 0) return {};
  const float cos_transmitted = std::sqrt(cos_squared);
  const float s = (cos_incident - eta * cos_transmitted) / (cos_incident + eta * cos_transmitted);
  const float p = (eta * cos_incident - cos_transmitted) / (eta * cos_incident + cos_transmitted);
  return {0.5f * (s * s + p * p), cos_transmitted};
}

/// The mean of dielectric_fresnel() over the cosine-weighted hemisphere of incident directions [1].
inline float average_dielectric_fresnel(float eta) {
  return hemisphere_mean([eta](float c) { return dielectric_fresnel(c, eta).reflectance; });
}

/// The exact unpolarized reflectance [1] of a conductor with the complex index eta - i k, seen from
/// vacuum; `cos_incident` is in [0, 1]. Uses the real-valued form of the Fresnel equations with n_t
/// cos_t = a - i b (Born and Wolf 1999, section 14.2).
inline float conductor_fresnel(float cos_incident, float eta, float k) {
  const float cos_squared = cos_incident * cos_incident;
  if (cos_squared == 0) return 1;  // grazing incidence: the formulas below may give 0 / 0
  const float sin_squared = std::max(0.0f, 1 - cos_squared);
  const float difference = eta * eta - k * k - sin_squared;  // a^2 - b^2
  const float twice_product = 2 * eta * k;                   // 2 a b
  const float sum = std::sqrt(difference * difference + twice_product * twice_product);  // a^2+b^2
  const float a = safe_sqrt(0.5f * (sum + difference));
  const float cross_s = 2 * a * cos_incident;
  const float s = (sum - cross_s + cos_squared) / (sum + cross_s + cos_squared);
  const float cross_p = cross_s * sin_squared;
  const float both_p = cos_squared * sum + sin_squared * sin_squared;
  const float p = s * (both_p - cross_p) / (both_p + cross_p);
  return std::clamp(0.5f * (s + p), 0.0f, 1.0f);
}

/// The reflectance of a conductor per color channel [1].
inline Rgb conductor_fresnel(float cos_incident, Rgb eta, Rgb k) {
  return {conductor_fresnel(cos_incident, eta.r, k.r), conductor_fresnel(cos_incident, eta.g, k.g),
          conductor_fresnel(cos_incident, eta.b, k.b)};
}

}  // namespace pharos
