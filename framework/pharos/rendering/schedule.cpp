#include <algorithm>
#include <cmath>
#include <limits>

#include <pharos/rendering/schedule.h>

namespace pharos {
namespace {

constexpr std::uint32_t kMostSamples = 1u << 30;
/// The share of a time budget with which `geometric` training begins. A single sample per pixel may
/// take so little time that it does not tell how long others will take.
constexpr double kFirstShare = 0.01;

/// Doubles a number of samples without overflow.
std::uint32_t doubled(std::uint32_t samples) {
  return std::min(2 * std::min(samples, kMostSamples), kMostSamples);
}

/// Returns the largest number of doubling iterations, at most `iterations`, that fit in `total`
/// samples.
std::uint32_t doubling_iterations(std::uint32_t iterations, std::uint32_t total) {
  std::uint32_t count = std::min(iterations, 30u);
  while (count > 0 && total < (1u << count) - 1) --count;
  return count;
}

}  // namespace

Schedule::Schedule(const Budget& budget, const TrainingSettings& training, std::uint32_t granule)
    : budget_(budget), kind_(training.schedule) {
  most_ = training.share > 0 ? training.iterations : 0;
  if (budget.seconds) {
    training_seconds_ = *budget.seconds * training.share;
  } else {
    const auto total = static_cast<std::uint32_t>(std::floor(*budget.spp * training.share));
    most_ = std::min(most_, total);
    const std::uint32_t parts =
        kind_ == ScheduleKind::uniform ? most_ : (1u << doubling_iterations(most_, total)) - 1;
    first_ = most_ > 0 ? total / parts : 0;
    training_samples_ = first_ * parts;
    const std::uint32_t left = *budget.spp - training_samples_;
    if (most_ > 0 && left > granule) training_samples_ += left % granule;
  }
  training_over_ = most_ == 0;
}

std::optional<Iteration> Schedule::next(const Spending& spending) {
  if (over_) return std::nullopt;
  if (training_over_) {
    over_ = true;
    return final_image(spending);
  }
  if (budget_.seconds && index_ > 0) size_ = spending.samples - samples_before_;
  samples_before_ = spending.samples;
  // Learners were told that this iteration follows, so there is one even if nothing is left for it.
  const std::uint32_t count = std::max(1u, fitting(spending)), most = largest(spending);
  const bool is_last = count == 1;
  Iteration iteration{
      .index = index_++, .training = true, .samples = most, .training_left = count - 1};
  if (budget_.spp) {
    iteration.samples =
        is_last ? std::min(most, training_samples_ - spending.samples) : wanted(spending);
  } else if (kind_ == ScheduleKind::uniform) {
    if (!is_last) iteration.least_samples = spending.region_minimum;
    iteration.deadline =
        std::min(training_seconds_ - (count - 1) * cost(wanted(spending), spending),
                 spending.seconds + most_seconds(spending));
  } else if (iteration.index == 0 && !is_last) {
    iteration.deadline =
        std::min(spending.seconds + kFirstShare * *budget_.seconds, training_seconds_);
  } else {
    if (!is_last) iteration.samples = wanted(spending);
    // Samples may take longer than in the last iteration, so a limited iteration has a limited
    // time.
    if (!is_last && is_limited(spending)) iteration.least_samples = spending.region_minimum;
    iteration.deadline = std::min(training_seconds_ - spending.update_seconds,
                                  spending.seconds + most_seconds(spending));
  }
  size_ = wanted(spending);
  training_over_ = is_last;
  return iteration;
}

Iteration Schedule::final_image(const Spending& spending) const {
  if (budget_.seconds) return {.index = index_, .deadline = *budget_.seconds};
  return {.index = index_, .samples = *budget_.spp - spending.samples};
}

double Schedule::left(const Spending& spending) const {
  return budget_.spp ? static_cast<double>(training_samples_) - spending.samples
                     : training_seconds_ - spending.seconds;
}

double Schedule::most_seconds(const Spending& spending) const {
  if (!is_limited(spending)) return std::numeric_limits<double>::infinity();
  // Where updates are dear, rendering takes at least half of the time.
  const double update = spending.update_seconds;
  return std::max(spending.largest_share * *budget_.seconds - update, update);
}

std::uint32_t Schedule::largest(const Spending& spending) const {
  if (!is_limited(spending)) return kMostSamples;
  double samples = budget_.spp
                       ? spending.largest_share * *budget_.spp
                       : most_seconds(spending) / std::max(spending.seconds_per_sample, 1e-9);
  samples *= 1 + 1e-9;  // a share of whole samples may have been rounded down
  return std::max(static_cast<std::uint32_t>(std::clamp(samples, 1.0, double{kMostSamples})),
                  spending.region_minimum);
}

std::uint32_t Schedule::wanted(const Spending& spending) const {
  const bool doubles = kind_ == ScheduleKind::geometric && size_ > 0;
  return std::clamp(doubles ? doubled(size_) : first_, spending.region_minimum, largest(spending));
}

double Schedule::cost(std::uint32_t samples, const Spending& spending) const {
  if (budget_.spp) return samples;
  const double rendering = samples * spending.seconds_per_sample;
  return kind_ == ScheduleKind::uniform ? std::max(training_seconds_ / most_, rendering)
                                        : rendering + spending.update_seconds;
}

std::uint32_t Schedule::fitting(const Spending& spending) const {
  double rest = left(spending);
  // Parts of equal time absorb what iterations and updates before them took too long.
  const double tolerance = budget_.seconds && kind_ == ScheduleKind::uniform ? 0.5 : 0;
  std::uint32_t size = wanted(spending), count = 0;
  while (index_ + count < most_ && rest >= (1 - tolerance) * cost(size, spending)) {
    rest -= cost(size, spending);
    if (kind_ == ScheduleKind::geometric) size = std::min(doubled(size), largest(spending));
    ++count;
  }
  return count;
}

std::uint32_t Schedule::longest() const {
  if (budget_.seconds) return 0;
  Schedule plan = *this;
  Spending spending;
  std::uint32_t longest = 0;
  while (const auto iteration = plan.next(spending)) {
    longest = std::max(longest, iteration->samples);
    spending.samples += iteration->samples;
  }
  return longest;
}

double Schedule::fraction(double samples, double seconds) const {
  return std::min(budget_.spp ? samples / *budget_.spp : seconds / *budget_.seconds, 1.0);
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
