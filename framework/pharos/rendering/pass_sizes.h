#pragma once

#include <cstdint>

#include <pharos/core/archive.h>
#include <pharos/rendering/schedule.h>

namespace pharos {

/// Chooses the number of samples per pixel of each pass of an iteration. Passes start small, and
/// each pass doubles the number of samples done, up to a limit. There is thus soon an image to
/// show, and the sums are powers of two. A pass is at most twice as large as the one
/// before it would have been if it had not been cut where the records end.
class PassSizes {
 public:
  /// The paths of the first `recorded` samples of the iteration are recorded. The smallest pass has
  /// `granule` samples. `now` is the time at which the iteration begins, on the clock of its
  /// deadline [s].
  PassSizes(const Iteration& iteration, std::uint32_t recorded, std::uint32_t granule, double now);

  /// Returns the size of the next pass after `done` samples at the time `now` [s]; 0 if the
  /// iteration is over. Passes of timed iterations double only while a pass takes less than 1/128
  /// of the iteration's time. A timed iteration ends before a pass that would exceed the deadline
  /// by more than the time that is left. The time of a pass is estimated from all passes so far,
  /// because a single one may have been delayed.
  std::uint32_t next(std::uint32_t done, double now);
  /// Returns the largest number of samples per pixel in a work unit of the pass that begins after
  /// `done` samples.
  std::uint32_t unit(std::uint32_t done) const;

  /// Saves the size of passes, or loads it for the same iteration or one with more samples.
  void archive(Archive& archive);

 private:
  std::uint32_t limit(std::uint32_t done) const;

  Iteration iteration_;
  std::uint32_t recorded_, granule_, size_;
  double start_, planned_seconds_;
};

}  // namespace pharos
