#include <algorithm>
#include <iterator>

#include <pharos/rendering/unit_plan.h>

namespace pharos {

void UnitPlan::add(std::uint32_t done, std::uint32_t samples, std::uint32_t unit,
                   std::size_t skipped) {
  passes_.push_back({count_, skipped, done, samples, unit});
  count_ += units_of(samples, unit, tiles_->size()) - skipped;
}

WorkUnit UnitPlan::operator[](std::size_t i) const {
  const Pass& pass = *std::prev(std::ranges::upper_bound(passes_, i, {}, &Pass::first));
  const std::size_t number = pass.skipped + i - pass.first;
  const auto before = static_cast<std::uint32_t>(number / tiles_->size()) * pass.unit;
  return {.pixels = (*tiles_)[number % tiles_->size()],
          .iteration = iteration_,
          .first_sample = pass.done + before,
          .sample_count = std::min(pass.unit, pass.samples - before)};
}

}  // namespace pharos
