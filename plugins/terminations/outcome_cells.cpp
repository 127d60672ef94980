#include "outcome_cells.h"

#include <algorithm>
#include <limits>

#include <pharos/core/warp.h>

namespace pharos {
namespace {

/// Returns the number as a float, the largest one if it is larger.
float limited(double number) {
  return static_cast<float>(std::min(number, double{std::numeric_limits<float>::max()}));
}

ExpectedOutcome expected(const OutcomeSums& sums) {
  if (!(sums.steps > 0)) return {};
  return {limited(sums.radiance / sums.steps), limited(sums.squared / sums.steps),
          limited(std::max(sums.cost / sums.steps, 1.0))};
}

/// Returns what was found below each plane and in each cell of the tree, by place and bin.
std::vector<OutcomeSums> sums_by_place(const OutcomeCells& cells, std::size_t bins) {
  const std::vector<std::uint32_t> leaves = cells.tree().leaves(), parents = cells.tree().parents();
  std::vector<OutcomeSums> sums(parents.size() * bins);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::copy(cells[i].bins.begin(), cells[i].bins.end(), sums.begin() + leaves[i] * bins);
  }
  for (std::size_t place = parents.size(); place-- > 1;) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      sums[parents[place] * bins + bin] += sums[place * bins + bin];
    }
  }
  return sums;
}

}  // namespace

OutcomeSums& OutcomeSums::operator+=(const OutcomeSums& other) {
  steps += other.steps;
  radiance += other.radiance;
  squared += other.squared;
  cost += other.cost;
  return *this;
}

void OutcomeSums::scale(double factor) {
  steps *= factor;
  radiance *= factor;
  squared *= factor;
  cost *= factor;
}

void OutcomeSums::archive(Archive& archive) {
  archive(steps, radiance, squared, cost);
  archive.expect(steps >= 0 && radiance >= 0 && squared >= 0 && cost >= 0,
                 "what was learned of steps");
}

std::size_t DirectionBins::at(Vec3 direction) const {
  const Vec2 u = warp::square_from_sphere(direction);
  const auto bin = [this](float x) {
    const auto i = static_cast<std::int64_t>(x * static_cast<float>(rows_));
    return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, rows_ - 1));
  };
  return bin(u.x) * rows_ + bin(u.y);
}

void OutcomeCell::forget(double factor) {
  for (OutcomeSums& bin : bins) bin.scale(factor);
}

void OutcomeCell::learn(std::span<const StepOutcome> outcomes, const DirectionBins& directions) {
  if (outcomes.empty()) return;
  bins.resize(directions.count());
  for (const StepOutcome& outcome : outcomes)
    bins[directions.at(outcome.towards_viewer)].add(outcome);
}

OutcomeField::OutcomeField(const OutcomeCells& cells, DirectionBins directions, double least_steps)
    : tree_(cells.tree()), directions_(directions) {
  const std::size_t bins = directions.count();
  const std::vector<OutcomeSums> sums = sums_by_place(cells, bins);
  const std::vector<std::uint32_t> leaves = tree_.leaves(), parents = tree_.parents();
  // Where no step was recorded, the mean over the whole scene counts.
  OutcomeSums all;
  for (std::size_t bin = 0; bin < bins; ++bin) all += sums[bin];
  expected_.reserve(cells.size() * bins);
  for (std::uint32_t place : leaves) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      std::size_t from = place;
      while (from > 0 && sums[from * bins + bin].steps < least_steps) from = parents[from];
      const OutcomeSums& found = sums[from * bins + bin];
      expected_.push_back(expected(found.steps > 0 ? found : all));
    }
  }
}

void OutcomeField::archive(Archive& archive) {
  archive(tree_, expected_);
  bool is_sound = expected_.size() == tree_.cell_count() * directions_.count();
  for (const ExpectedOutcome& e : expected_) {
    is_sound &= e.radiance >= 0 && e.squared >= 0 && e.cost >= 1;
  }
  archive.expect(is_sound, "what was learned of steps");
}

}  // namespace pharos
