#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/rendering/budget.h>

namespace pharos {

enum class ScheduleKind { uniform, geometric };
enum class TrainingImages { discard, combine };

template <>
struct EnumNames<ScheduleKind> {
  static constexpr std::array<std::pair<std::string_view, ScheduleKind>, 2> names{
      {{"uniform", ScheduleKind::uniform}, {"geometric", ScheduleKind::geometric}}};
};
template <>
struct EnumNames<TrainingImages> {
  static constexpr std::array<std::pair<std::string_view, TrainingImages>, 2> names{
      {{"discard", TrainingImages::discard}, {"combine", TrainingImages::combine}}};
};

/// One stretch of a render: an image of its own, with the guide frozen.
struct Iteration {
  std::uint32_t samples = 0;  ///< a pixel; 0: bounded by seconds
  double seconds = 0;         ///< 0: bounded by samples
  bool training = false;      ///< paths are recorded and the model is updated afterwards
  bool keeps_image = true;    ///< its pixels count in the result
};

/// How a budget is divided into training iterations and the final image.
struct TrainingSchedule {
  ScheduleKind schedule = ScheduleKind::uniform;
  std::uint32_t iterations = 15;  ///< of training
  double share = 0.5;             ///< of the budget spent on training
  TrainingImages images = TrainingImages::discard;
  std::uint32_t latest_images = 1001;  ///< that are combined at most, the final one included

  static void describe(Schema<TrainingSchedule>& schema);

  /// The iterations of a guided render, the final one last. A sample budget is divided exactly:
  /// `uniform` gives all training iterations the same number of samples and `geometric` doubles
  /// them; fewer are made where the budget does not suffice. What training leaves over goes to the
  /// final image, as far as this has whole granules of `granule` samples (a sampler's preferred
  /// number) then, and the rest of it to the last training iteration. Without training the budget
  /// is one iteration.
  std::vector<Iteration> divide(const Budget& budget, std::uint32_t granule) const;
};

}  // namespace pharos
