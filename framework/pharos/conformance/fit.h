#pragma once

#include <string>

#include <pharos/conformance/check.h>
#include <pharos/statistics/goodness_of_fit.h>

namespace pharos::conformance {

/// One sampler of directions and the density it claims.
struct DirectionFit {
  statistics::Draw<Vec3> draw;        ///< empty: no result, or one of another measure
  statistics::Density<Vec3> density;  ///< [1/sr]
  std::string where;                  ///< the configuration, for messages
  double rim = 0;           ///< share of draws [1] that may lie just outside the support, where the
                            ///< density is found by a ray that may miss
  double tolerance = 1e-4;  ///< of quadrature [1]; less for densities that cost rays
  std::size_t draws = 60'000;  ///< half of them find the cells
};

/// Feeds the checks `chi_square` (counts in about 60 cells against the density) and `integral` (the
/// density is finite and not negative, and its integral is the share of draws with a result, within
/// 0.5 % and their errors).
void test_directions(const DirectionFit& fit, std::uint64_t seed, Check& chi_square,
                     Check& integral);

/// Two-sided p-value of a standard normal deviate.
double normal_p_value(double z);

}  // namespace pharos::conformance
