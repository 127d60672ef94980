#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include <pharos/core/random.h>
#include <pharos/core/vec.h>

/// Tests whether samples follow the density that is claimed for them.
namespace pharos::statistics {

struct ChiSquareResult {
  double statistic = 0;
  int degrees_of_freedom = 0;
  double p_value = 1;  ///< 1 if only one cell is left after pooling
};

/// Pearson's chi-square test of observed counts against expected counts with the same total. Each
/// cell has one of both. Cells with an expected count below `min_expected` are pooled, smallest
/// first.
ChiSquareResult chi_square_test(std::span<const double> observed, std::span<const double> expected,
                                double min_expected = 5);

/// Draws one sample. The result is empty for a draw without a result (a zero sample, or an event of
/// another measure).
template <class T>
using Draw = std::function<std::optional<T>(RandomStream&)>;
/// Evaluates a density. Directions are unit vectors with densities in [1/sr]; points lie in [0,1)^2
/// with densities in [1].
template <class T>
using Density = std::function<double(T)>;

struct FitOptions {
  /// The number of draws. Half of the draws choose the cells, the other half is tested.
  std::size_t draws = 200'000;
  std::uint64_t seed = 1;
  /// The approximate number of cells. Draws spread over them evenly, wherever the density peaks.
  int cells = 200;
  double quadrature_tolerance = 1e-4;  ///< for the integral over the whole domain [1]
};

/// The result of a test of draws against a density.
struct DensityFit {
  /// Tests the counts against the integral of the density over each cell. Draws without a result
  /// form one more cell.
  ChiSquareResult chi_square;
  double integral = 0;              ///< integral of the density over the whole domain [1]
  double integral_error = 0;        ///< estimated quadrature error of `integral` [1]
  double missed = 0;                ///< share of tested draws without a result [1]
  std::size_t outside_support = 0;  ///< tested draws whose density is not positive and finite
  /// Number of quadrature nodes where the density is negative or not finite. They count as zero.
  std::size_t invalid_nodes = 0;

  /// Returns whether the density passes the checks that need no statistics: it is finite and not
  /// negative, it integrates to at most one (within `tolerance` and the quadrature error), and no
  /// draw lies outside its support.
  bool is_density(double tolerance = 1e-3) const {
    return outside_support == 0 && invalid_nodes == 0 && integral <= 1 + tolerance + integral_error;
  }
};

/// Tests draws of directions against their density over the sphere [1/sr]. The integral of the
/// density plus the share of draws without a result must be one. Each cell must receive the share
/// of draws that the integral of the density over the cell predicts. Cells and quadrature patches
/// follow the draws (by bisecting 1 - cos(theta) and phi), so lobes of any width are resolved.
DensityFit fit_direction_density(const Draw<Vec3>& draw, const Density<Vec3>& density,
                                 const FitOptions& options = {});

/// Tests draws of points of the unit square in the same way.
DensityFit fit_square_density(const Draw<Vec2>& draw, const Density<Vec2>& density,
                              const FitOptions& options = {});

}  // namespace pharos::statistics
