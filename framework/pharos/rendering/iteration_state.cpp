#include <pharos/rendering/iteration_state.h>

namespace pharos {

bool IterationState::begin_pass(double now) {
  if (pass == 0) pass = sizes.next(done, now);
  return pass > 0;
}

void IterationState::merge(const WorkUnit& unit, const FilmTile& tile) {
  film.merge(tile);
  pixel_samples += static_cast<double>(unit.pixels.area()) * unit.sample_count;
  ++units;
}

void IterationState::end_pass(bool complete) {
  if (units > 0) film.end_pass(samples_of_pass(), complete);
  if (complete) done += pass;
  pass = 0;
  units = 0;
  pixel_samples = 0;
}

UnitPlan IterationState::units_left(const std::vector<PixelRect>& tiles, std::uint32_t iteration,
                                    bool all_passes) const {
  UnitPlan plan(tiles, iteration);
  plan.add(done, pass, sizes.unit(done), units);
  if (!all_passes) return plan;
  PassSizes later = sizes;
  std::uint32_t begin = done + pass;
  while (const std::uint32_t samples = later.next(begin, 0)) {
    plan.add(begin, samples, later.unit(begin));
    begin += samples;
  }
  return plan;
}

}  // namespace pharos
