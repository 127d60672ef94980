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
  static constexpr auto names =
      std::to_array<EnumName<ScheduleKind>>({{"uniform", ScheduleKind::uniform}, {"geometric", ScheduleKind::geometric}});
};
template <>
struct EnumNames<TrainingImages> {
  static constexpr auto names =
      std::to_array<EnumName<TrainingImages>>({{"discard", TrainingImages::discard}, {"combine", TrainingImages::combine}});
};

/// How much of a render's budget trains its guides, and what becomes of the images of training.
struct TrainingSettings {
  ScheduleKind schedule = ScheduleKind::uniform;
  std::uint32_t iterations = 15;  ///< of training
  double share = 0.5;             ///< of the budget that is spent on training
  TrainingImages images = TrainingImages::discard;
  std::uint32_t latest_images = 1001;  ///< most images that are combined, the final one included

  static void describe(Schema<TrainingSettings>& schema);
};

}  // namespace pharos
