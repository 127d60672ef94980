#pragma once

#include <pharos/core/lanes3.h>
#include <pharos/core/simd.h>
#include <pharos/guiding/toolkit/scattering_lobes.h>
#include <pharos/statistics/von_mises_fisher.h>

namespace pharos {

/// Returns |a - w|^2. For unit vectors this is 2 (1 - cos) and keeps the digits of small angles.
inline Float8 squared_distance(const Lanes3<Float8>& a, Vec3 w) {
  const Lanes3<Float8> d{a.x - w.x, a.y - w.y, a.z - w.z};
  return dot(d, d);
}

/// Returns the densities at the means of von Mises-Fisher lobes for kappa >=
/// von_mises_fisher::kLeastKappa [1/sr]. For flat lobes it uses the series, because the difference
/// in the formula would lose digits.
inline Float8 mode_density8(const Float8& kappa) {
  constexpr float kOverTwoPi = 0.159154943f, kFlat = 0.1f;
  const Float8 flat = 0.5f * kOverTwoPi * (1 + kappa * (1 + (1.0f / 3) * kappa));
  return kappa < kFlat ? flat : kappa * kOverTwoPi / (1 - exp(-2 * kappa));
}

/// The products of eight von Mises-Fisher densities with one lobe. They are lobes again.
struct LobeProducts {
  Lanes3<Float8> mean;  ///< unit
  Float8 kappa;
  Float8 mode;      ///< density at the mean of the product, normalized [1/sr]
  Float8 integral;  ///< of the product over all directions
};

/// Multiplies the densities of eight lobes with this mean, concentration and density at the mean:
/// kappa' mu' = kappa mu + kappa_f mu_f. The integral is the quotient of the densities at the means
/// times e^(kappa' - kappa - kappa_f). This exponent equals -kappa kappa_f |mu - mu_f|^2 / (kappa'
/// + kappa + kappa_f).
inline LobeProducts multiply(const Lanes3<Float8>& mean, const Float8& kappa, const Float8& mode,
                             const ScatteringLobe& factor) {
  const Vec3 f = factor.kappa * factor.mean;
  const Float8 apart = squared_distance(mean, factor.mean);
  const Float8 x = kappa * mean.x + f.x, y = kappa * mean.y + f.y, z = kappa * mean.z + f.z;
  const Float8 length = sqrt(x * x + y * y + z * z);
  LobeProducts product;
  product.kappa = larger(length, all8(von_mises_fisher::kLeastKappa));
  const Float8 over = 1 / product.kappa;
  const Float8 exponent = -kappa * factor.kappa * apart / (product.kappa + kappa + factor.kappa);
  product.mode = mode_density8(product.kappa);
  product.integral = factor.peak * (mode / product.mode) * exp(exponent);
  // The product of opposite lobes of the same concentration is a flat lobe.
  const Mask8 is_flat = length < von_mises_fisher::kLeastKappa;
  product.mean = {is_flat ? mean.x : x * over, is_flat ? mean.y : y * over,
                  is_flat ? mean.z : z * over};
  return product;
}

}  // namespace pharos
