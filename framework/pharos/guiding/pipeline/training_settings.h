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
  double share = 0.5;             ///< share of the budget that is spent on training [1]
  TrainingImages images = TrainingImages::discard;
  /// Largest number of combined images, including the final one.
  std::uint32_t latest_images = 1001;

  static void describe(Schema<TrainingSettings>& schema);
};

}  // namespace pharos
