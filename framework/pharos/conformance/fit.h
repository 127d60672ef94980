#pragma once

#include <string>

#include <pharos/conformance/check.h>
#include <pharos/statistics/goodness_of_fit.h>

namespace pharos::conformance {

/// A sampler of directions and the density that it claims.
struct DirectionFit {
  statistics::Draw<Vec3> draw;        ///< empty: no result, or a result of another measure
  statistics::Density<Vec3> density;  ///< [1/sr]
  std::string where;                  ///< describes the configuration in messages
  double rim = 0;  ///< fraction of draws [1] that may lie just outside the support, because the
                   ///< density is found by a ray, which may miss
  double tolerance = 1e-4;  ///< tolerance of quadrature [1]; larger for densities that trace rays
  std::size_t draws = 60'000;  ///< half of the draws determine the cells
};

/// Adds results to the checks `chi_square` and `integral`. `chi_square` compares counts in about 60
/// cells with the density. `integral` requires that the density is finite and not negative, and
/// that its integral is the fraction of draws with a result, within 0.5 % and the errors of both.
void test_directions(const DirectionFit& fit, std::uint64_t seed, Check& chi_square,
                     Check& integral);

/// The two-sided p-value of a standard normal deviate.
double normal_p_value(double z);

}  // namespace pharos::conformance
