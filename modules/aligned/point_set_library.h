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

/// Names a set that the library holds or makes.
struct SetName {
  std::uint32_t points = 0;  ///< a power of two, 2^6 to 2^16
  std::vector<int>
      directions;  ///< low-energy ones beside the axes [degrees], ascending; one or two

  friend auto operator<=>(const SetName&, const SetName&) = default;
};

/// Where the points for some directions come from: a set, and what turns it to them.
struct SetChoice {
  SetName set;
  Symmetry symmetry;
};

/// The set that serves `directions`, one or two whole ones in [0, 180) degrees, and all that are
/// symmetric to them: of the four symmetric lists of directions the first in lexicographic order.
/// One direction is served by 46 sets, 0 to 45 degrees.
SetChoice choose_set(std::span<const int> directions, std::uint32_t points);

/// Point sets with low energy along both axes and along one or two further directions (section 5.4
/// of the paper). Those of one direction, by degrees, of 2^6, 2^8, 2^10 and 2^12 points are part of
/// the program. All others are synthesized when they are first asked for and kept in the cache,
/// which never changes what a set holds. Directions are angles from the x axis towards the y axis,
/// modulo 180, along which the spectrum is low: those of the edges' normals.
///
///     const PointSetLibrary library({});
///     const PointSet set = library.find(std::vector{31.4}, 4096);   // low along 0, 31 and 90
///
/// Constant and safe to be used by several threads at once.
class PointSetLibrary {
 public:
  struct Options {
    std::filesystem::path cache_folder;  ///< empty: default_set_folder()
    /// Sets of two directions exist on a grid of so many degrees: a divisor of 45.
    int pair_step = 5;
  };

  /// Throws InputError for another pair_step.
  explicit PointSetLibrary(Options options);

  /// The directions [whole degrees in [0, 180), ascending] that the set for `wanted`, at most two,
  /// is aligned with beside the axes. One is rounded to degrees; two to the grid of pairs. Of two
  /// one stays where they are rounded to the same, or one to an axis. {0}, the axes alone, where
  /// none is left. Throws InputError for more than two.
  std::vector<int> snapped(std::span<const double> wanted) const;

  /// The set for snapped(wanted). Takes long where it has to be synthesized. Throws InputError for
  /// other numbers of points than powers of two from 2^6 to 2^16, and as snapped() does.
  PointSet find(std::span<const double> wanted, std::uint32_t points) const;

  /// A set by its name, which choose_set() told. Empty where the control stopped its synthesis.
  std::optional<PointSet> find(const SetName& name, const SynthesisControl& control = {}) const;

  /// The names of all sets of this many directions, one or two, and points.
  std::vector<SetName> names(int directions, std::uint32_t points) const;

 private:
  int pair_step_;
  SetCache cache_;
};

/// What a set of the library is synthesized with.
SynthesisSettings settings_of(const SetName& name);

}  // namespace pharos::aligned
