#include <algorithm>

#include <pharos/rendering/pass_sizes.h>

namespace pharos {
namespace {

/// Smallest number of passes of an iteration: enough for an estimate of variance.
constexpr std::uint32_t kPasses = 8;
/// Largest number of samples per pixel in a work unit. It limits how long a unit takes, and so how
/// soon a render stops.
constexpr std::uint32_t kUnitSamples = 64;
/// The same for units whose paths are recorded. It limits the memory of logs.
constexpr std::uint32_t kRecordedUnitSamples = 4;

/// Returns the largest size of a pass, a multiple of `granule`.
std::uint32_t largest(const Iteration& iteration, std::uint32_t granule) {
  const std::uint32_t wanted = iteration.samples / kPasses + (iteration.samples % kPasses != 0);
  const std::uint32_t most = std::min(wanted, unit_samples(iteration));
  return (most + granule - 1) / granule * granule;
}

}  // namespace

std::uint32_t unit_samples(const Iteration& iteration) {
  return iteration.training ? kRecordedUnitSamples : kUnitSamples;
}

PassSizes::PassSizes(const Iteration& iteration, std::uint32_t granule, double now)
    : iteration_(iteration),
      limit_(largest(iteration, granule)),
      size_(granule),
      start_(now),
      planned_seconds_(iteration.deadline - now) {}

std::uint32_t PassSizes::next(std::uint32_t done, double now) {
  const double pass = done > 0 ? (now - start_) * size_ / done : 0;
  const bool is_late = iteration_.deadline - now < pass / 2;
  if (is_late && done >= iteration_.least_samples) return 0;
  if (pass * 128 < planned_seconds_) size_ = std::clamp(done, size_, limit_);
  return std::min(size_, iteration_.samples - done);
}

void PassSizes::archive(Archive& archive) {
  archive(size_);
  archive.expect(size_ > 0, "the size of passes");
  size_ = std::min(size_, limit_);
}

}  // namespace pharos
