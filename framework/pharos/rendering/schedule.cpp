#include <algorithm>
#include <cmath>

#include <pharos/rendering/schedule.h>

namespace pharos {
namespace {

/// Returns the number of samples of each training iteration. There are as many iterations as
/// requested, or as many as `total` allows.
std::vector<std::uint32_t> training_samples(ScheduleKind kind, std::uint32_t iterations,
                                            std::uint32_t total) {
  if (kind == ScheduleKind::uniform) {
    const std::uint32_t count = std::min(iterations, total);
    return std::vector<std::uint32_t>(count, count > 0 ? total / count : 0);
  }
  std::uint32_t count = std::min(iterations, 31u);
  while (count > 0 && total < (1u << count) - 1) --count;
  if (count == 0) return {};
  const std::uint32_t first = total / ((1u << count) - 1);
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t i = 0; i < count; ++i) sizes.push_back(first << i);
  return sizes;
}

/// Drops the first training images, so that the remaining ones and the final image are at most
/// `latest` images.
void keep_latest(std::vector<Iteration>& iterations, std::uint32_t latest) {
  for (std::size_t i = 0; i + latest < iterations.size(); ++i) iterations[i].keeps_image = false;
}

}  // namespace

std::vector<Iteration> divide(const Budget& budget, const TrainingSettings& settings,
                              std::uint32_t granule) {
  const auto& [schedule, iterations, share, images, latest_images] = settings;
  const bool keeps = images == TrainingImages::combine;
  std::vector<Iteration> all;
  if (budget.seconds) {
    const double training = share > 0 && iterations > 0 ? *budget.seconds * share : 0;
    double size = schedule == ScheduleKind::uniform
                      ? training / iterations
                      : training / (std::exp2(static_cast<double>(iterations)) - 1);
    for (std::uint32_t i = 0; training > 0 && i < iterations; ++i) {
      all.push_back({.seconds = size, .training = true, .keeps_image = keeps});
      if (schedule == ScheduleKind::geometric) size *= 2;
    }
    all.push_back({.seconds = *budget.seconds - training});
    keep_latest(all, latest_images);
    return all;
  }
  const auto wanted = static_cast<std::uint32_t>(std::floor(*budget.spp * share));
  std::uint32_t left = *budget.spp;
  for (const std::uint32_t samples : training_samples(schedule, iterations, wanted)) {
    all.push_back({.samples = samples, .training = true, .keeps_image = keeps});
    left -= samples;
  }
  if (!all.empty() && left > granule) {
    all.back().samples += left % granule;
    left -= left % granule;
  }
  all.push_back({.samples = left});
  keep_latest(all, latest_images);
  return all;
}

void Budget::describe(Schema<Budget>& s) {
  s.field("spp", &Budget::spp, "Samples per pixel, including training")
      .at_least(1)
      .at_most(1 << 30);
  s.field("seconds", &Budget::seconds, "Wall-clock time of rendering and training")
      .unit("s")
      .above(0);
}

}  // namespace pharos
