#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/pass_sizes.h>
#include <pharos/rendering/unit_plan.h>

namespace pharos {

/// The current iteration of a render between two work units.
struct IterationState {
  Film film;
  PassSizes sizes;
  double start = 0;          ///< on the budget's clock [s]
  std::uint32_t done = 0;    ///< samples per pixel of whole passes
  std::uint32_t pass = 0;    ///< samples per pixel of the pass in progress; 0: there is none
  std::uint64_t units = 0;   ///< work units of this pass that are merged
  double pixel_samples = 0;  ///< samples of these units, of all pixels together

  /// Makes the next pass the current one unless there is one. `now` is the time on the budget's
  /// clock [s]. Returns false if the iteration is over.
  bool begin_pass(double now);
  /// Adds the result of the next work unit.
  void merge(const WorkUnit& unit, const FilmTile& tile);
  /// Ends the current pass, which is `complete` unless the render was stopped.
  void end_pass(bool complete);

  /// Returns the number of work units in the current pass on a film of so many tiles.
  std::size_t unit_count(std::size_t tiles) const {
    return UnitPlan::units_of(pass, sizes.unit(done), tiles);
  }
  /// Returns the units of the current pass that are not merged yet. If `all_passes` is true, the
  /// units of all later passes follow. `iteration` is the number of the iteration.
  UnitPlan units_left(const std::vector<PixelRect>& tiles, std::uint32_t iteration,
                      bool all_passes) const;
  /// Returns the number of samples per pixel so far.
  double samples() const { return done + samples_of_pass(); }

  void archive(Archive& archive) { archive(film, sizes, done, pass, units, pixel_samples); }

 private:
  double samples_of_pass() const {
    return pixel_samples / static_cast<double>(film.window().area());
  }
};

}  // namespace pharos
