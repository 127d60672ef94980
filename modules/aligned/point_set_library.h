#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "point_set.h"
#include "set_cache.h"
#include "synthesis.h"

namespace pharos::aligned {

/// The name of a set that the library holds or synthesizes.
struct SetName {
  std::uint32_t points = 0;     ///< a power of two, 2^6 to 2^16
  std::vector<int> directions;  ///< directions of low energy in addition to the axes [degrees], one
                                ///< or two, ascending

  friend auto operator<=>(const SetName&, const SetName&) = default;
};

/// The source of the points for some directions: a set, and the symmetry that maps it to these
/// directions.
struct SetChoice {
  SetName set;
  Symmetry symmetry;
};

/// Returns the set that serves `directions` and all directions that are symmetric to them.
/// `directions` holds one or two whole numbers in [0, 180) degrees. Of the four symmetric lists of
/// directions, the function selects the first in lexicographic order. 46 sets, 0 to 45 degrees,
/// serve all single directions.
SetChoice choose_set(std::span<const int> directions, std::uint32_t points);

/// Point sets with low energy along both axes and along one or two further directions (section 5.4
/// of the paper). The sets of one direction, in steps of one degree, with 2^6, 2^8, 2^10 and 2^12
/// points are part of the program. All other sets are synthesized when they are first requested,
/// and kept in the cache. The cache never changes the content of a set. Directions are angles from
/// the x axis toward the y axis, modulo 180, along which the spectrum is low: the directions of the
/// edges' normals.
///
///     const PointSetLibrary library({});
///     const PointSet set = library.find(std::vector{31.4}, 4096);   // low along 0, 31 and 90
///
/// Constant and thread-safe.
class PointSetLibrary {
 public:
  struct Options {
    std::filesystem::path cache_folder;  ///< if empty, default_set_folder()
    /// Spacing of the grid of directions for sets of two directions [degrees]; a divisor of 45.
    int pair_step = 5;
  };

  /// Throws InputError for any other pair_step.
  explicit PointSetLibrary(Options options);

  /// Returns the directions [whole degrees in [0, 180), ascending], in addition to the axes, with
  /// which the set for `wanted` is aligned. `wanted` holds at most two directions. A single
  /// direction is rounded to whole degrees. Two directions are rounded to the grid of pairs. If
  /// both round to the same direction, or one of them to an axis, a single direction remains. If no
  /// direction remains, the result is {0}, the axes alone. Throws InputError for more than two
  /// directions.
  std::vector<int> snapped(std::span<const double> wanted) const;

  /// Returns the set for snapped(wanted). Takes long if the set has to be synthesized. Throws
  /// InputError if the number of points is not a power of two from 2^6 to 2^16, and in the same
  /// cases as snapped().
  PointSet find(std::span<const double> wanted, std::uint32_t points) const;

  /// Returns the set with a name that choose_set() returned. The result is empty if `control`
  /// stopped the synthesis.
  std::optional<PointSet> find(const SetName& name, const SynthesisControl& control = {}) const;

  /// Returns the names of all sets with this number of directions, one or two, and this number of
  /// points.
  std::vector<SetName> names(int directions, std::uint32_t points) const;

 private:
  int pair_step_;
  SetCache cache_;
};

/// Returns the settings with which a set of the library is synthesized.
SynthesisSettings settings_of(const SetName& name);

}  // namespace pharos::aligned
