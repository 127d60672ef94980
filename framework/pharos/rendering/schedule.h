#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include <pharos/core/archive.h>
#include <pharos/guiding/pipeline/training_settings.h>
#include <pharos/rendering/budget.h>

namespace pharos {

/// One iteration of a render. It renders an image of its own, and the guides are frozen meanwhile.
/// It ends after `samples` or at `deadline`, whichever comes first, but not before `least_samples`.
struct Iteration {
  std::uint32_t index = 0;  ///< number of iterations before it
  bool training = false;    ///< paths are recorded and the models are updated afterward
  /// Samples per pixel.
  std::uint32_t samples = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t least_samples = 1;  ///< per pixel
  /// Seconds since the budget's clock started.
  double deadline = std::numeric_limits<double>::infinity();
  /// Expected number of training iterations that follow; see TrainingStage::left.
  std::uint32_t training_left = 0;

  bool is_timed() const { return deadline < std::numeric_limits<double>::infinity(); }
  void archive(Archive& archive) {
    archive(index, training, samples, least_samples, training_left);
    archive.unchecked(deadline);
  }
};

/// What a render has spent so far, and what its last iteration has shown.
struct Spending {
  std::uint32_t samples = 0;      ///< per pixel
  double seconds = 0;             ///< that the budget counts
  double seconds_per_sample = 0;  ///< of rendering the last iteration [seconds per spp]
  double update_seconds = 0;      ///< of the last update
  /// Samples per pixel with which every region of the models gets enough training samples.
  std::uint32_t region_minimum = 1;
  /// Largest share of the budget that the next training iteration may take, update included [1].
  /// It may always have `region_minimum` samples, and render for as long as an update takes.
  double largest_share = 1;

  void archive(Archive& archive) {
    archive(samples, seconds, seconds_per_sample, update_seconds, region_minimum, largest_share);
  }
};

/// Divides a budget into training iterations and the final image, one iteration at a time. A sample
/// budget is kept exactly, and its division does not depend on the clock.
///
/// - `uniform` training has `iterations` parts of equal size.
/// - `geometric` training doubles the samples from one iteration to the next. With a time budget it
///   begins with a hundredth of the time, and at least one sample per pixel. If another iteration
///   of twice the size would not fit after an iteration, that iteration is the last one and uses
///   all the time left for training.
///
/// An iteration that would give the models' regions too few samples is longer, so there are fewer.
/// An iteration that may take only a small share of the budget is shorter, so there may be more, up
/// to `iterations`; what training then does not use goes to the final image. With a time budget,
/// it ends in time even if its samples take longer than in the last iteration.
/// If the budget does not suffice, there are fewer iterations, too. The samples that training
/// leaves over go to the final image in whole granules of `granule` samples (the preferred number
/// of a sampler), and the rest go to the last training iteration. Without training, the budget is
/// one iteration.
class Schedule {
 public:
  Schedule(const Budget& budget, const TrainingSettings& training, std::uint32_t granule);

  /// Returns the next iteration. After the final image there is none.
  std::optional<Iteration> next(const Spending& spending);
  /// Returns the final image, which takes all of the budget that training has left.
  Iteration final_image(const Spending& spending) const;
  /// Ends training early. The next iteration is the final image.
  void end_training() { training_over_ = true; }

  /// Returns the number of samples per pixel of the longest iteration, as far as it is known before
  /// the render; 0 for a time budget.
  std::uint32_t longest() const;
  /// Returns the fraction of the budget that was spent, in [0, 1].
  double fraction(double samples, double seconds) const;

  void archive(Archive& archive) { archive(index_, size_, samples_before_, training_over_, over_); }

 private:
  /// Returns the part of the budget that is left for training [spp or seconds].
  double left(const Spending& spending) const;
  static bool is_limited(const Spending& spending) { return spending.largest_share < 1; }
  /// Returns how long the next training iteration may render, with a time budget [s].
  double most_seconds(const Spending& spending) const;
  /// Returns the largest size that the next training iteration may have [spp].
  std::uint32_t largest(const Spending& spending) const;
  /// Returns the size of the next training iteration if enough is left for it [spp].
  std::uint32_t wanted(const Spending& spending) const;
  /// Returns the part of the budget that a training iteration of `samples` takes [spp or seconds].
  double cost(std::uint32_t samples, const Spending& spending) const;
  /// Returns how many training iterations fit in what is left of the training.
  std::uint32_t fitting(const Spending& spending) const;

  Budget budget_;
  ScheduleKind kind_;
  std::uint32_t most_ = 0;              ///< largest number of training iterations
  std::uint32_t first_ = 1;             ///< size of the first one [spp]
  std::uint32_t training_samples_ = 0;  ///< of a sample budget [spp]
  double training_seconds_ = 0;         ///< of a time budget

  std::uint32_t index_ = 0;           ///< of the next iteration
  std::uint32_t size_ = 0;            ///< of the last training iteration [spp]
  std::uint32_t samples_before_ = 0;  ///< of all iterations before the last one [spp]
  bool training_over_ = false;        ///< no training iteration follows
  bool over_ = false;
};

}  // namespace pharos
