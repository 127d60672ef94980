#pragma once

#include <cmath>
#include <numbers>

/// The standard normal distribution and its integrals from minus infinity.
namespace pharos::laboratory {

inline double normal_density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
}
inline double normal_distribution(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}
/// Returns the integral of normal_distribution() from minus infinity to z.
inline double first_integral(double z) {
  return z * normal_distribution(z) + normal_density(z);
}
/// Returns the integral of first_integral() from minus infinity to z.
inline double second_integral(double z) {
  return 0.5 * ((z * z + 1) * normal_distribution(z) + z * normal_density(z));
}

}  // namespace pharos::laboratory
