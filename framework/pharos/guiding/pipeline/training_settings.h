#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>

namespace pharos {

enum class ScheduleKind { uniform, geometric };
enum class TrainingImages { discard, combine };
enum class FinalPixels { even, adaptive };

template <>
struct EnumNames<ScheduleKind> {
  static constexpr auto names = std::to_array<EnumName<ScheduleKind>>(
      {{"uniform", ScheduleKind::uniform}, {"geometric", ScheduleKind::geometric}});
};
template <>
struct EnumNames<FinalPixels> {
  static constexpr auto names = std::to_array<EnumName<FinalPixels>>(
      {{"even", FinalPixels::even}, {"adaptive", FinalPixels::adaptive}});
};
template <>
struct EnumNames<TrainingImages> {
  static constexpr auto names = std::to_array<EnumName<TrainingImages>>(
      {{"discard", TrainingImages::discard}, {"combine", TrainingImages::combine}});
};

/// The part of a render's budget that trains the guides, and the use of the images of training.
struct TrainingSettings {
  ScheduleKind schedule = ScheduleKind::uniform;
  std::uint32_t iterations = 15;  ///< number of training iterations
  double share = 0.5;             ///< largest share of the budget that is spent on training [1]
  TrainingImages images = TrainingImages::combine;
  /// How the samples of the final image are shared among the pixels: all get the same number, or
  /// more go where the training images are noisy; see PixelNoise. Training images are even.
  FinalPixels pixels = FinalPixels::even;
  /// Largest number of samples per pixel of an iteration whose paths are recorded. The rest of the
  /// iteration only adds to its image. 0: all are recorded.
  std::uint32_t recorded_samples = 0;
  /// Largest number of combined images, including the final one.
  std::uint32_t latest_images = 1001;
  /// Least mean number of training samples for each region of the largest model in an iteration.
  double region_samples = 32;
  /// Training ends once another iteration is expected neither to raise the gain of the guides nor
  /// to lower the logarithm of the noise by this [nats], and by what the iteration costs; see
  /// GuideTrial. 0: it ends only with its share.
  double tolerance = 0;
  /// The final image is not guided if the gain of the guides is less than this [nats]. 0: always
  /// guided.
  double least_gain = 0;
  /// A gain below `least_gain` still suffices if guides lower the mean squared error that an image
  /// has after the same time to this part or less [1]; see GuideTrial. 0: it does not.
  double most_noise = 0;
  /// A method is left out of the rest of the render if, without it, the gain would have been lower
  /// by less than this in each of its last two measurements [nats]. 0: none is left out.
  double least_part = 0;
  /// With the iteration that ends nearest to this share of the budget, training ends if the guides
  /// do not suffice, unless the noise may fall by enough to be worth the time of another iteration,
  /// or, with `most_noise` 0, the gain may reach `least_gain` in it. Nothing is decided before.
  /// Until they surely suffice (the gain exceeds `least_gain` by a standard error, or the noise is
  /// low enough), an iteration takes at most the rest of this share or half of the share, whichever
  /// is larger, or more as long as the gain is unknown; see GuideTrial::worthwhile_share() and
  /// Spending::largest_share.
  double trial = 1.0 / 16;

  /// Returns how many of the first `samples` samples per pixel of an iteration are recorded.
  std::uint32_t recorded(std::uint32_t samples) const {
    return recorded_samples == 0 ? samples : std::min(samples, recorded_samples);
  }

  /// Returns whether anything depends on how much the guides help.
  bool puts_guides_on_trial() const { return tolerance > 0 || least_gain > 0 || least_part > 0; }

  static void describe(Schema<TrainingSettings>& schema);
};

}  // namespace pharos
