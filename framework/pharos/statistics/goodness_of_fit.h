#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include <pharos/core/random.h>
#include <pharos/core/vec.h>

/// Whether samples follow the density that is claimed for them.
namespace pharos::statistics {

struct ChiSquareResult {
  double statistic = 0;
  int degrees_of_freedom = 0;
  double p_value = 1;  ///< 1 when there is only one cell left to look at
};

/// Pearson's chi-square test of counts against expected counts of the same total, one each a cell.
/// Cells that expect fewer than `min_expected` are pooled, smallest first.
ChiSquareResult chi_square_test(std::span<const double> observed, std::span<const double> expected,
                                double min_expected = 5);

/// One draw of a sampler: empty for a draw without a result (a zero sample, an event of another
/// measure).
template <class T>
using Draw = std::function<std::optional<T>(RandomStream&)>;
/// Directions are unit vectors, densities [1/sr]; points lie in [0,1)^2, densities are [1].
template <class T>
using Density = std::function<double(T)>;

struct FitOptions {
  /// Half of the draws choose the cells, the other half is tested.
  std::size_t draws = 200'000;
  std::uint64_t seed = 1;
  /// About how many cells; draws spread over them evenly, wherever the density peaks.
  int cells = 200;
  double quadrature_tolerance = 1e-4;  ///< of the integral over everything [1]
};

/// How well draws fit a density.
struct DensityFit {
  /// Counts against the density's integral over each cell; draws without a result are a cell too.
  ChiSquareResult chi_square;
  double integral = 0;              ///< of the density over everything [1]
  double integral_error = 0;        ///< estimated quadrature error of `integral` [1]
  double missed = 0;                ///< share of tested draws without a result [1]
  std::size_t outside_support = 0;  ///< tested draws whose density is not positive and finite
  /// Quadrature nodes where the density is negative or not finite; they count as zero.
  std::size_t invalid_nodes = 0;

  /// Whether the density passes what needs no statistics: it is finite and not negative, integrates
  /// to at most one (within `tolerance` and the quadrature error), and no draw lies outside its
  /// support.
  bool is_density(double tolerance = 1e-3) const {
    return outside_support == 0 && invalid_nodes == 0 && integral <= 1 + tolerance + integral_error;
  }
};

/// Tests draws of directions against their density over the sphere [1/sr]. The density's integral
/// plus the share of draws without a result must be one, and draws must fall into each cell as
/// often as the density's integral over it says. Cells and quadrature patches follow the
/// draws (bisecting 1 - cos(theta) and phi), so lobes of any width are resolved.
DensityFit fit_direction_density(const Draw<Vec3>& draw, const Density<Vec3>& density,
                                 const FitOptions& options = {});

/// The same for points of the unit square.
DensityFit fit_square_density(const Draw<Vec2>& draw, const Density<Vec2>& density,
                              const FitOptions& options = {});

}  // namespace pharos::statistics
