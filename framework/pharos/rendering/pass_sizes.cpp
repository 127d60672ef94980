#include <algorithm>

#include <pharos/rendering/pass_sizes.h>

namespace pharos {
namespace {

/// Smallest number of passes of an iteration: enough for an estimate of variance.
constexpr std::uint32_t kPasses = 8;
/// Number of passes of a long iteration that has a number of samples, without and with records.
/// Between passes, threads wait for each other, and all of them for what the learners do. So fewer
/// passes suit more threads; but only they show an image.
constexpr std::uint32_t kLongPasses = 64, kRecordedPasses = 16;
/// Largest number of samples per pixel in a work unit, and in one of a long iteration. It limits
/// how long a unit takes, and so how soon a render stops.
constexpr std::uint32_t kUnitSamples = 64, kLongUnitSamples = 256;
/// The same for units whose paths are recorded. It limits the memory of logs.
constexpr std::uint32_t kRecordedUnitSamples = 4;

}  // namespace

PassSizes::PassSizes(const Iteration& iteration, std::uint32_t recorded, std::uint32_t granule,
                     double now)
    : iteration_(iteration),
      recorded_(recorded),
      granule_(granule),
      size_(granule),
      start_(now),
      planned_seconds_(iteration.deadline - now) {}

std::uint32_t PassSizes::unit(std::uint32_t done) const {
  if (done < recorded_) return kRecordedUnitSamples;
  if (iteration_.is_timed()) return kUnitSamples;
  return std::clamp(iteration_.samples / kLongPasses / 4, kUnitSamples, kLongUnitSamples);
}

/// Returns the largest size of the pass after `done` samples, a multiple of the granule.
std::uint32_t PassSizes::limit(std::uint32_t done) const {
  const std::uint32_t wanted = iteration_.samples / kPasses + (iteration_.samples % kPasses != 0);
  std::uint32_t most = unit(done);
  if (!iteration_.is_timed()) {
    const std::uint32_t passes = done < recorded_ ? kRecordedPasses : kLongPasses;
    most = std::max(most, iteration_.samples / passes / most * most);  // whole units
  }
  most = std::min(wanted, most);
  return (most + granule_ - 1) / granule_ * granule_;
}

std::uint32_t PassSizes::next(std::uint32_t done, double now) {
  const double pass = done > 0 ? (now - start_) * size_ / done : 0;
  const bool is_late = iteration_.deadline - now < pass / 2;
  if (is_late && done >= iteration_.least_samples) return 0;
  if (pass * 128 < planned_seconds_) {
    // The estimate may fall below the limit late, when `done` would be far too much.
    size_ = std::clamp(std::min(done, 2 * size_), size_, limit(done));
  }
  // A pass is recorded as a whole or not at all.
  const std::uint32_t end = done < recorded_ ? recorded_ : iteration_.samples;
  return std::min(size_, end - done);
}

void PassSizes::archive(Archive& archive) {
  archive(size_);
  archive.expect(size_ > 0, "the size of passes");
  if (archive.loads()) size_ = std::min(size_, std::max(limit(0), limit(recorded_)));
}

}  // namespace pharos
