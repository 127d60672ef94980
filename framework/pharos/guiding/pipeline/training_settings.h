#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>

namespace pharos {

enum class ScheduleKind { uniform, geometric };
enum class TrainingImages { discard, combine };

template <>
struct EnumNames<ScheduleKind> {
  static constexpr auto names = std::to_array<EnumName<ScheduleKind>>(
      {{"uniform", ScheduleKind::uniform}, {"geometric", ScheduleKind::geometric}});
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
  /// Largest number of combined images, including the final one.
  std::uint32_t latest_images = 1001;
  /// Least mean number of training samples for each region of the largest model in an iteration.
  double region_samples = 32;
  /// Training ends once the gain of the guides changes by less than this from one iteration to the
  /// next [nats]; see HeldOutGain. 0: it ends only with its share.
  double tolerance = 0;
  /// The final image is not guided if the gain of the guides is less than this [nats]. 0: always
  /// guided.
  double least_gain = 0;
  /// Once this share of the budget is spent, training ends if the gain is less than `least_gain`,
  /// and would be after another rise like the last one. A gain that exceeds `least_gain` by less
  /// than a standard error limits the next iteration to this share; see Spending::largest_share.
  double trial = 1.0 / 16;

  static void describe(Schema<TrainingSettings>& schema);
};

}  // namespace pharos
